// SPDX-License-Identifier: MIT
// The tilted box without an engine: the closed form, told to physvib.h.
#include "TurnedBrick.h"
#include <optional>

struct Plain final : tilted::BrickEngine {
    Plain() { isExact = true; }
    void begin(double stepSeconds) override { dt = stepSeconds, walls.clear(); }
    void wall(int id, const tilted::Vector& place, const tilted::Vector& normal) override {
        walls.push_back({id, place, normal});
    }
    void drop(const tilted::Vector& centre, const tilted::Vector& velocity) override {
        at = centre, v = velocity, thrown.reset();
    }
    void throwBrick(const tilted::Brick& brick, const tilted::Vector& centre,
                    const tilted::Vector& velocity) override {
        at = centre, v = velocity, thrown = brick;
    }
    void step() override {
        physvib_world_begin_step(world, dt, 0.0);
        move(0.0);
        tilted::Vector end = at, after = v;
        for (std::size_t k = 0; k < 3; ++k) end[k] += v[k] * dt;
        for (const Wall& wall : walls) {
            const tilted::Vector from{at[0] - wall.place[0], at[1] - wall.place[1], at[2] - wall.place[2]};
            const double gap = tilted::dot(from, wall.normal) + tilted::dot(reach(wall), wall.normal),
                         speed = -tilted::dot(v, wall.normal);
            if (!(speed > 0.0 && gap >= 0.0 && gap < speed * dt)) continue;
            touch(wall, gap, gap / speed);
            const double rest = dt - gap / speed; // walls meet at right angles, so each changes its own part
            for (std::size_t k = 0; k < 3; ++k) {
                after[k] += (1.0 + tilted::restitution) * speed * wall.normal[k];
                end[k] += (1.0 + tilted::restitution) * speed * wall.normal[k] * rest;
            }
        }
        physvib_world_end_step(world);
        at = end, v = after;
    }
    tilted::Vector centre() const override { return at; }
    tilted::Vector velocity() const override { return v; }

private:
    struct Wall {
        int id;
        tilted::Vector place, normal;
    };
    /// From the centre to what touches the wall.
    tilted::Vector reach(const Wall& wall) const {
        return thrown ? thrown->corner(wall.normal) : tilted::plus({}, -tilted::radius, wall.normal);
    }
    void move(double seconds) const {
        const double still[3] = {0, 0, 0};
        physvib_world_move_in_space(world, tilted::ball, tilted::plus(at, seconds, v).data(), v.data(), still,
                                    thrown ? thrown->inverse().data() : nullptr);
    }
    void touch(const Wall& wall, double gap, double seconds) const {
        physvib_contact contact;
        physvib_contact_init(&contact, sizeof contact);
        const auto point = [&](std::size_t k) { return at[k] + v[k] * seconds + reach(wall)[k]; };
        contact.a = wall.id, contact.b = tilted::ball;
        contact.x_m = point(0), contact.y_m = point(1), contact.z_m = point(2);
        contact.normal_x = wall.normal[0], contact.normal_y = wall.normal[1],
        contact.normal_z = wall.normal[2];
        contact.restitution = tilted::restitution;
        contact.gap_m = gap; // at the start of the step
        move(seconds);       // levers are those of the moment for which the point is told
        if (physvib_world_touch(world, &contact) != PHYSVIB_OK) std::puts(physvib_error());
    }
    double dt = 0;
    tilted::Vector at{}, v{};
    std::optional<tilted::Brick> thrown; // else the ball
    std::vector<Wall> walls;
};

int main() {
    Plain engine;
    return tilted::run("none", engine) | tilted::runBricks("none", engine);
}
