// SPDX-License-Identifier: GPL-3.0-or-later
// A million guarded blocks of a live session while another thread edits it ten thousand times.
#include "Core/NameNumbers.h"
#include "Live/Documents/InputLine.h"
#include "Live/Session/Session.h"
#include "Realtime/RealtimeGuard.h"
#include "Scene/SceneFile.h"
#include "Support/ClosedForm.h"
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace physvib::realtime_render_test {

constexpr int outputs = 8;

PhantomPanner randomPanner(test::Random& random) {
    ActuatorLayout layout{1, 1, 1 + random.below(outputs), {}};
    for (int j = 0; j < layout.count; ++j)
        layout.places[static_cast<std::size_t>(j)] = {random.uniform(0, 1), random.uniform(0, 1)};
    return {layout, static_cast<PanningLaw>(random.below(4)), 1.0, 6.4, 3.6};
}

OwnedControl randomEdit(test::Random& random) {
    OwnedControl edit;
    edit.kind = static_cast<RenderControl::Kind>(random.below(4));
    edit.channel = random.below(outputs);
    edit.value = static_cast<float>(random.below(3)) - 1.0f;
    if (edit.kind == RenderControl::Kind::panner)
        edit.panner = (edit.ownedPanner = std::make_shared<const PhantomPanner>(randomPanner(random))).get();
    return edit;
}

CollisionEvent randomPath(test::Random& random, std::int64_t fromNs) {
    CollisionEvent path;
    path.timeNs = fromNs;
    path.durationNs = 1'000'000 * (1 + random.below(200));
    path.frequencyHz = random.uniform(50, 400);
    path.amplitude = 0.1;
    path.course = {random.uniform(0, 6.4), random.uniform(0, 3.6), path.durationNs, 0};
    path.spread = static_cast<Spread>(random.below(static_cast<int>(spreadNames.size())));
    return path;
}

// One of many, at a rate of its own: it is kept, then struck.
bool strikeClip(Session& session, test::Random& random) {
    const int which = random.below(maxClips);
    CollisionEvent strike;
    const ContactRecording clip{0.0,
                                8000 + 1000 * which,
                                std::vector<float>(2000, 0.1f),
                                {.path = std::to_string(which), .hash = "0123456789abcdef"}};
    strike.frequencyHz = clipFrequencyHz;
    strike.sound = soundOfClip(session.addClip({&clip, 1}).value());
    strike.amplitude = 1.0;
    strike.durationNs = 100'000'000;
    strike.timeNs = session.timeline().presentNs();
    return bool{session.submit({Strikes{{&strike, 1}, true}, 0})};
}

// Layouts, gains, mutes and stops; now and then an input, a strike that moves, a clip, another scene, or the
// same one from its start.
bool edit(Session& session, test::Random& random) {
    const int kind = random.below(200);
    if (kind < 4) return session.submit({TiltAction{random.uniform(-3, 3)}}).error.empty();
    if (kind == 4) session.world().restart(random.below(64));
    if (kind >= 6 && kind < 16)
        return bool{session.submit(
            {Strikes{std::array{randomPath(random, session.timeline().presentNs() + random.below(1'000'000))},
                     true},
             0})};
    if (kind == 5) {
        const char* const scenes[] = {"shake-the-box", "fruit-basket", "drop"};
        session.world().setState(
            {std::make_shared<const Scene>(*findBuiltInScene(scenes[random.below(3)])), 1});
    }
    if (kind == 16) return strikeClip(session, random);
    return kind < 6 || session.submit({randomEdit(random)}).error.empty();
}

TEST(RealtimeRender, AMillionBlocksUnderTenThousandEditsDoNothingForbidden) {
    test::Random random{1};
    SessionSetup setup;
    setup.scene = *findBuiltInScene("shake-the-box");
    setup.channels = outputs;
    setup.panner = randomPanner(random);
    setup.equalised[1] = {{205, 8}, {180, 230}};
    setup.equalised[5] = {{110, 2}, {90, 1000}};
    setup.shaping.remap.band = {90, 1000};
    // heard as a recording; the others as modes
    setup.contactSound = std::vector<ContactRecording>{{430.0, 48000, std::vector<float>(4800, 0.5f)}};
    Session session{setup};
    session.prepare(48000, 64);
    std::atomic<bool> stop{false};
    std::atomic<std::uint64_t> edits{0}, played{0}, ticks{0};
    std::thread message{[&] { // M and D
        test::Random mine{2};
        while (!stop) {
            session.advance();
            ++ticks;
            if (edits < 10'000 && edit(session, mine)) ++edits;
            for (PlayedEvent e; session.played().pop(e);) ++played;
            std::this_thread::sleep_for(std::chrono::microseconds{50});
        }
    }};
    std::vector<std::vector<float>> samples(outputs + 1, std::vector<float>(64)); // the last is heard
    std::vector<float*> at;
    for (auto& channel : samples) at.push_back(channel.data());
    float loudest = 0, heard = 0;
    test::RealtimeGuard::forget();
    for (int block = 0; block < 1'000'000 || edits < 10'000 || played <= 1000; ++block) {
        if (block % 256 == 0) // this host is faster than time; the world must keep up
            for (const auto before = ticks.load(); ticks < before + 2;) std::this_thread::yield();
        const int frames = 1 + random.below(64);
        {
            const test::RealtimeGuard guard;
            session.render(at.data(), frames, RenderMode::realtime);
        }
        for (int n = 0; n < frames; ++n)
            loudest = std::max(loudest, std::abs(samples[0][static_cast<std::size_t>(n)])),
            heard = std::max(heard, std::abs(samples[outputs][static_cast<std::size_t>(n)]));
    }
    stop = true;
    message.join();
    for (int i = 0; i < test::RealtimeGuard::offenceCount; ++i)
        EXPECT_EQ(test::RealtimeGuard::count(static_cast<test::RealtimeGuard::Offence>(i)), 0u)
            << test::RealtimeGuard::names[static_cast<std::size_t>(i)];
    EXPECT_GE(edits, 10'000u);
    EXPECT_GT(played, 1000u);
    EXPECT_LE(loudest, 1.0f);
    EXPECT_GT(heard, 0.0f);
}

} // namespace physvib::realtime_render_test
