// SPDX-License-Identifier: GPL-3.0-or-later
// A hash over every field of every event, and over all counts, of many worlds: one line per world. Two builds
// of the library that print the same make the same events to the bit: hashes.sh compares.
//   hashes WORLDS [FIRST]  the worlds of Worlds.h, then so many random ones, from that seed on
#include "Worlds.h"
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace physvib;

/// FNV-1a over values of any type without padding.
class Hash {
public:
    template <class... Values>
    void add(const Values&... values) {
        (addBytes(reinterpret_cast<const unsigned char*>(&values), sizeof values), ...);
    }
    void add(const std::vector<CollisionEvent>& events) {
        for (const CollisionEvent& e : events) {
            add(e.timeNs, e.frequencyHz, e.decayPerSecond, e.amplitude, e.x, e.y, e.z, e.durationNs, e.spread,
                e.sound);
            add(e.source.fixture, e.source.other, e.source.impulseNewtonSeconds, e.source.massKg,
                e.source.kind, e.source.part);
            add(e.course.toX, e.course.toY, e.course.toZ, e.course.travelNs, e.course.toneAgeNs);
        }
        count_ += events.size();
    }
    void add(const ContactCounts& c) {
        add(c.contacts, c.belowThreshold, c.withoutSource, c.unplayable, c.muted, c.settling, c.dropped,
            c.events, c.immovable);
        add(c.minX, c.minY, c.maxX, c.maxY, c.strongestBelowMetresPerSecond, c.fastestApproachMetresPerSecond,
            c.thresholdMetresPerSecond);
    }
    void add(const std::string& text) {
        addBytes(reinterpret_cast<const unsigned char*>(text.data()), text.size());
    }
    void print(const std::string& name) const {
        std::printf("%-24s %7zu events  %016llx\n", name.c_str(), count_,
                    static_cast<unsigned long long>(value_));
    }

private:
    void addBytes(const unsigned char* bytes, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211ULL;
    }
    std::uint64_t value_ = 14695981039346656037ULL;
    std::size_t count_ = 0;
};

/// Draws, the same with every library.
class Dice {
public:
    explicit Dice(std::uint32_t seed)
        : random_{seed} {}
    int below(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }
    bool oneIn(int count) { return below(count) == 0; }
    float within(float least, float most) {
        return least + (most - least) * static_cast<float>(random_()) * 0x1p-32F;
    }
    double among(std::initializer_list<double> values) {
        return *(values.begin() + below(static_cast<int>(values.size())));
    }

private:
    std::mt19937 random_;
};

/// A game's own listener: one-way platforms, and pushes where bodies meet.
class Game final : public b2ContactListener {
public:
    bool disables = false, pushes = false;
    void PreSolve(b2Contact* contact, const b2Manifold*) override {
        const b2Body &a = *contact->GetFixtureA()->GetBody(), &b = *contact->GetFixtureB()->GetBody();
        if (disables && a.GetLinearVelocity().y + b.GetLinearVelocity().y > 0.2F) contact->SetEnabled(false);
        if (pushes && ++calls_ % 7 == 0) contact->SetTangentSpeed(0.3F);
    }
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
        if (pushes && ++calls_ % 31 == 0)
            contact->GetFixtureB()->GetBody()->ApplyLinearImpulseToCenter(
                {0.02F * impulse->normalImpulses[0], 0.05F}, true);
    }

private:
    int calls_ = 0;
};

/// Bodies of every kind in a yard with rough ground, and what a game does to them.
class RandomWorld {
public:
    explicit RandomWorld(std::uint32_t seed)
        : dice_{seed}
        , isFast_{dice_.oneIn(4)} {
        game_.disables = dice_.oneIn(4);
        game_.pushes = dice_.oneIn(5);
        if (game_.disables || game_.pushes) world_.SetContactListener(&game_);
        world_.SetContinuousPhysics(!dice_.oneIn(6));
        world_.SetAllowSleeping(!dice_.oneIn(3));
        world_.SetWarmStarting(!dice_.oneIn(8));
        world_.SetSubStepping(dice_.oneIn(12));
        attachment_ = std::make_unique<Attachment>(world_, settings());
        if (dice_.oneIn(5)) second_ = std::make_unique<Attachment>(world_, settings());
        hertz_ = static_cast<float>(dice_.among({30.0, 60.0, 100.0, 100.0, 240.0, 1000.0}));
        addGround();
        const int count = 2 + dice_.below(dice_.oneIn(4) ? 50 : 14);
        for (int i = 0; i < count; ++i) addBody();
    }

    void run(int steps, Hash& hash) {
        for (int i = 0; i < steps; ++i) {
            meddle(i);
            const float seconds = dice_.oneIn(60) ? 0.0F : dice_.oneIn(10) ? 2.0F / hertz_ : 1.0F / hertz_;
            if (second_) second_->beginStep(static_cast<double>(seconds));
            if (dice_.oneIn(8)) {
                attachment_->beginStep(static_cast<double>(seconds));
                world_.Step(seconds, 8, 3);
                if (dice_.oneIn(6) && !bodies_.empty())
                    destroy(dice_.below(static_cast<int>(bodies_.size())));
                attachment_->endStep();
            } else {
                attachment_->step(seconds);
            }
            if (second_) second_->endStep();
            if (dice_.oneIn(3)) continue;
            for (Attachment* const each : {attachment_.get(), second_.get()}) {
                events_.clear();
                if (each == nullptr) continue;
                if (dice_.oneIn(20))
                    each->flush(events_);
                else
                    each->take(events_);
                hash.add(events_);
            }
        }
        for (Attachment* const each : {attachment_.get(), second_.get()})
            if (each != nullptr) {
                events_.clear();
                each->flush(events_);
                hash.add(events_);
                hash.add(each->counts());
                hash.add(each->drops(), each->overBudget());
                hash.add(each->explain());
            }
    }

private:
    ImpactSettings settings() {
        ImpactSettings s;
        s.fieldWidthMetres = 8.0;
        if (dice_.oneIn(4)) s.timing = ImpactTiming::release;
        if (dice_.oneIn(6)) s.location = ImpactLocation::fixture;
        if (dice_.oneIn(5)) s.hitsPerStep = dice_.below(3);
        if (dice_.oneIn(4)) s.fullScaleNewtonSeconds = dice_.oneIn(2) ? ImpactSettings::automatic : 0.3;
        if (dice_.oneIn(5)) s.settlingSeconds = 0.33;
        if (dice_.oneIn(4)) s.keepsHitsOfDestroyed = false;
        if (dice_.oneIn(20)) s.isMuted = true;
        if (dice_.oneIn(3)) s.fieldRadians = dice_.within(-3.0F, 3.0F);
        if (dice_.oneIn(3)) s.fieldOrigin = {dice_.within(-3.0F, 3.0F), dice_.within(-3.0F, 3.0F)};
        if (dice_.oneIn(3)) s.thresholdMetresPerSecond = static_cast<double>(dice_.within(0.0F, 0.5F));
        if (dice_.oneIn(3)) s.handMassKg = 0.2;
        return s;
    }
    HapticFixture values(bool isSource) {
        HapticFixture v{dice_.among({0.0, 3.0, 60.0, 90.0, 120.0, 200.0, 250.0, 349.0}),
                        static_cast<double>(dice_.within(20.0F, 100.0F)), isSource,
                        dice_.among({0.0, 5.0, 5.0, 340.0, 340.0}), static_cast<Voice>(dice_.below(3))};
        if (dice_.oneIn(2)) v.texture.grainMetres = dice_.among({0.0002, 0.001, 0.002, 0.005, 0.02, 0.2});
        v.texture.roughness = dice_.among({1.0, 1.0, 0.1, 30.0});
        v.texture.pattern = dice_.oneIn(3) ? GrainPattern::regular : GrainPattern::random;
        v.texture.rolling = dice_.among({0.2, 0.0, 1.0});
        if (dice_.oneIn(4)) v.overtones[0] = {420.0, 70.0, 0.5};
        if (dice_.oneIn(8)) v.overtones[2] = {dice_.among({2.0, 1200.0}), 40.0, 0.3};
        v.surface = dice_.below(4);
        v.gain = dice_.among({1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 2.5});
        if (dice_.oneIn(5)) v.handMassKg = 0.7;
        v.sound = dice_.oneIn(6) ? 3 : 0;
        v.part = dice_.below(3);
        return v;
    }
    void give(b2Fixture& fixture, bool isSource) {
        if (dice_.oneIn(9)) return;
        (void)attachment_->set(fixture, values(isSource));
        if (second_ && !dice_.oneIn(4)) (void)second_->set(fixture, values(dice_.oneIn(2)));
    }
    void addGround() {
        const b2BodyDef def;
        ground_ = world_.CreateBody(&def);
        b2ChainShape chain;
        std::vector<b2Vec2> line;
        for (int i = 0; i <= 24; ++i)
            line.push_back({static_cast<float>(12 - i) * 0.5F,
                            dice_.oneIn(2) ? 0.0F : dice_.within(0.0F, isFast_ ? 0.5F : 0.15F)});
        chain.CreateChain(line.data(), static_cast<int>(line.size()), {6.5F, 0.0F}, {-6.5F, 0.0F});
        b2EdgeShape edge;
        edge.SetTwoSided({-8.0F, 0.0F}, {8.0F, 0.0F});
        const bool isChain = dice_.oneIn(2);
        give(*ground_->CreateFixture(isChain ? static_cast<b2Shape*>(&chain) : &edge, 0.0F), !dice_.oneIn(8));
        for (const float side : {-6.0F, 6.0F}) {
            edge.SetTwoSided({side, -1.0F}, {side, 8.0F});
            give(*ground_->CreateFixture(&edge, 0.0F), dice_.oneIn(2));
        }
        if (!dice_.oneIn(3)) return;
        b2BodyDef moving;
        moving.type = b2_kinematicBody;
        moving.position = {0.0F, 0.8F};
        moving.linearVelocity = {0.5F, 0.0F};
        moving.angularVelocity = dice_.within(-1.0F, 1.0F);
        b2PolygonShape box;
        box.SetAsBox(1.0F, 0.1F);
        give(*world_.CreateBody(&moving)->CreateFixture(&box, 0.0F), dice_.oneIn(2));
    }
    void addShape(b2Body& body, b2Vec2 at) {
        const float size = dice_.within(0.08F, 0.35F);
        b2CircleShape circle;
        circle.m_radius = size;
        circle.m_p = at;
        b2PolygonShape polygon;
        if (dice_.oneIn(3)) {
            b2Vec2 corners[5];
            for (int i = 0; i < 5; ++i)
                corners[i] = at + b2Vec2{size * std::cos(1.2566F * static_cast<float>(i)),
                                         size * std::sin(1.2566F * static_cast<float>(i))};
            polygon.Set(corners, 5);
        } else {
            polygon.SetAsBox(size, dice_.within(0.05F, 0.3F), at, dice_.within(0.0F, 3.0F));
        }
        b2FixtureDef def;
        def.shape = dice_.oneIn(2) ? static_cast<b2Shape*>(&circle) : &polygon;
        def.density = dice_.within(1.0F, 500.0F);
        def.friction = dice_.within(0.0F, 1.0F);
        def.restitution = dice_.oneIn(2) ? 0.0F : dice_.within(0.0F, 0.8F);
        def.isSensor = dice_.oneIn(15);
        give(*body.CreateFixture(&def), dice_.oneIn(3));
    }
    void addBody() {
        b2BodyDef def;
        def.type = b2_dynamicBody;
        def.bullet = dice_.oneIn(6);
        def.allowSleep = !dice_.oneIn(4);
        def.fixedRotation = dice_.oneIn(12);
        def.gravityScale = dice_.oneIn(10) ? 0.3F : 1.0F;
        def.position = {dice_.within(-5.0F, 5.0F), dice_.within(0.3F, 4.0F)};
        def.angle = dice_.within(-3.0F, 3.0F);
        const float speed = isFast_ ? 30.0F : 2.0F;
        def.linearVelocity = {dice_.within(-speed, speed), dice_.within(-speed, speed)};
        def.angularVelocity = dice_.within(-5.0F, 5.0F);
        b2Body& body = *world_.CreateBody(&def);
        addShape(body, {0.0F, 0.0F});
        while (dice_.oneIn(4)) addShape(body, {dice_.within(-0.3F, 0.3F), dice_.within(-0.3F, 0.3F)});
        bodies_.push_back(&body);
    }
    void destroy(int which) {
        b2Body* const body = bodies_[static_cast<std::size_t>(which)];
        bodies_.erase(bodies_.begin() + which);
        if (dice_.oneIn(4))
            for (b2Fixture* f = body->GetFixtureList(); f != nullptr; f = body->GetFixtureList()) {
                attachment_->remove(*f);
                if (second_) second_->remove(*f);
                body->DestroyFixture(f);
            }
        world_.DestroyBody(body);
    }
    /// What a game may do between steps.
    void meddle(int step) {
        if (step % 40 == 0) world_.SetGravity({dice_.within(-4.0F, 4.0F), -9.8F});
        if (dice_.oneIn(50)) addBody();
        if (dice_.oneIn(70)) attachment_->configure(settings());
        if (dice_.oneIn(90)) attachment_->shiftOrigin({dice_.within(-0.1F, 0.1F), 0.0F});
        if (dice_.oneIn(60)) (void)attachment_->setPair(1, dice_.below(4), {dice_.among({0.0, 111.0}), 50.0});
        if (bodies_.empty() || !dice_.oneIn(12)) return;
        const int which = dice_.below(static_cast<int>(bodies_.size()));
        b2Body& body = *bodies_[static_cast<std::size_t>(which)];
        switch (dice_.below(8)) {
        case 0: destroy(which); break;
        case 1: body.SetAwake(dice_.oneIn(2)); break;
        case 2: body.SetEnabled(!body.IsEnabled()); break;
        case 3: body.SetLinearVelocity({dice_.within(-3.0F, 3.0F), dice_.within(-1.0F, 3.0F)}); break;
        case 4: body.SetType(dice_.oneIn(3) ? b2_staticBody : b2_dynamicBody); break;
        case 5: give(*body.GetFixtureList(), dice_.oneIn(2)); break;
        case 6: attachment_->remove(*body.GetFixtureList()); break;
        case 7: body.SetTransform(body.GetPosition() + b2Vec2{0.0F, 0.4F}, body.GetAngle()); break;
        }
    }

    Dice dice_;
    bool isFast_;
    float hertz_ = 100.0F;
    Game game_;
    b2World world_{{0.0F, -9.8F}};
    std::unique_ptr<Attachment> attachment_, second_;
    b2Body* ground_ = nullptr;
    std::vector<b2Body*> bodies_;
    std::vector<CollisionEvent> events_;
};

void shake(int bodies, int cameras, int steps) {
    bench::ShakenBox box{bodies};
    Attachment attachment{box.world, {.fieldWidthMetres = 6.4}};
    box.setAll(attachment, cameras);
    std::vector<CollisionEvent> events;
    Hash hash;
    for (int i = 0; i < steps; ++i) {
        box.shake(i);
        attachment.step(bench::stepSeconds);
        events.clear();
        attachment.take(events);
        hash.add(events);
    }
    hash.add(attachment.counts());
    hash.print("box " + std::to_string(bodies) + " " + std::to_string(cameras));
}

void roll(double grainMetres, int steps) {
    bench::RollingBalls world{100, grainMetres};
    Hash hash;
    for (int i = 0; i < steps; ++i) {
        world.step(i);
        hash.add(world.events);
    }
    hash.add(world.attachment.counts());
    hash.print("balls " + std::to_string(grainMetres));
}

} // namespace

int main(int count, char** arguments) {
    if (count < 2) return 2;
    const int worlds = std::atoi(arguments[1]), first = count > 2 ? std::atoi(arguments[2]) : 1;
    for (const int bodies : {10, 100, 1000})
        for (const int cameras : {0, 4, 5000}) shake(bodies, cameras, bodies == 1000 ? 60 : 300);
    for (const double grainMetres : {0.0, 0.02, 0.005, 0.002}) roll(grainMetres, 300);
    for (int i = 0; i < worlds; ++i) {
        Hash hash;
        RandomWorld world{static_cast<std::uint32_t>(first + i)};
        world.run(240, hash);
        hash.print("seed " + std::to_string(first + i));
    }
    return 0;
}
