// SPDX-License-Identifier: MIT
// The tilted box through MuJoCo's adapter. The field's y is MuJoCo's z, and its z MuJoCo's -y.
#include "TurnedBrick.h"
#include <fstream>
#include <memory>
#include <physvib/engines/physvib_mujoco.h>
#include <sstream>
#include <string>

/// Walls are springs of 200 rad/s, hardly damped. Stiffer ones gain energy at 240 steps/s.
struct MuJoCo final : tilted::BrickEngine {
    void begin(double stepSeconds) override {
        std::ostringstream head;
        head.precision(17);
        head << "<mujoco><option timestep='" << stepSeconds
             << "' gravity='0 0 0' collision='predefined'/><worldbody>";
        xml = head.str();
        model.reset();
    }
    void wall(int id, const tilted::Vector& place, const tilted::Vector& normal) override {
        xml += "<body pos='" + text(place) + "' zaxis='" + text(normal) + "'><geom name='" +
               std::to_string(id) + "' type='plane' size='1 1 1'/></body>";
    }
    void drop(const tilted::Vector& centre, const tilted::Vector& velocity) override {
        throwShape("type='sphere' size='" + std::to_string(tilted::radius) + "'", "", centre, velocity);
    }
    void throwBrick(const tilted::Brick& brick, const tilted::Vector& centre,
                    const tilted::Vector& velocity) override {
        const tilted::Vector& half = brick.halfMetres;
        throwShape("type='box' size='" + std::to_string(half[0]) + " " + std::to_string(half[1]) + " " +
                       std::to_string(half[2]) + "'",
                   "' xyaxes='" + text(brick.box.axis[0]) + " " + text(brick.box.axis[1]), centre, velocity);
    }
    void throwShape(const std::string& shape, const std::string& turned, const tilted::Vector& centre,
                    const tilted::Vector& velocity) {
        std::ostringstream body;
        body << "<body pos='" << text(centre) << turned << "'><freejoint/><geom name='ball' " << shape
             << " mass='" << tilted::massKg << "'/></body></worldbody><contact>";
        for (int id = 1; id <= 6; ++id)
            body << "<pair geom1='ball' geom2='" << id << "' condim='1' solref='0.1 0.05'/>";
        body << "</contact></mujoco>";
        const std::string path = "tilted.xml"; // a world is a file here
        std::ofstream(path) << xml << body.str();
        char fault[500] = "";
        model.reset(mj_loadXML(path.c_str(), nullptr, fault, sizeof fault));
        if (model == nullptr) std::puts(fault);
        data.reset(mj_makeData(model.get()));
        data->qvel[0] = velocity[0], data->qvel[1] = -velocity[2], data->qvel[2] = velocity[1];
        mj_forward(model.get(), data.get());
    }
    static std::string text(const tilted::Vector& v) {
        std::ostringstream to;
        to.precision(17);
        to << v[0] << ' ' << -v[2] << ' ' << v[1];
        return to.str();
    }
    static tilted::Vector vector(const mjtNum* v) { return {v[0], v[2], -v[1]}; }
    void step() override {
        if (physvib_mujoco_step(model.get(), data.get(), world, tilted::restitution) != PHYSVIB_OK)
            std::puts(physvib_error());
    }
    tilted::Vector centre() const override { return vector(data->qpos); }
    tilted::Vector velocity() const override { return vector(data->qvel); }
    struct Free {
        void operator()(mjModel* m) const { mj_deleteModel(m); }
        void operator()(mjData* d) const { mj_deleteData(d); }
    };
    std::string xml;
    std::unique_ptr<mjModel, Free> model;
    std::unique_ptr<mjData, Free> data;
};

int main() {
    MuJoCo engine;
    return tilted::run("MuJoCo", engine) | tilted::runBricks("MuJoCo", engine);
}
