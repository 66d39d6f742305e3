// SPDX-License-Identifier: MIT
// MuJoCo through its adapter.
#include "Scenes.h"
#include <physvib/engines/physvib_mujoco.h>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

struct MuJoCo final : scenes::Engine {
    void begin(double stepSeconds, double g, double, bool hasFloor) override {
        std::ostringstream head;
        head << "<mujoco><option timestep='" << stepSeconds << "' gravity='0 0 " << -g << "'/><worldbody>";
        if (hasFloor) head << "<geom type='plane' size='5 5 1' solref='0.02 0.2155'/>"; // a damping that gives half of the speed back
        xml = head.str();
        places.clear();
        model.reset();
        hasGravity = g > 0;
    }
    void ball(double x, double y, double vx, double vy) override {
        std::ostringstream body;
        body << "<body pos='" << x << " 0 " << y << "'><freejoint/><geom type='sphere' solref='0.02 0.2155' size='" << scenes::radius << "' mass='" << scenes::massKg << "'/></body>";
        xml += body.str();
        places.push_back({vx, vy});
    }
    void load() { // a world is a file here
        const std::string path = "engine.xml";
        std::ofstream(path) << xml << "</worldbody></mujoco>";
        char fault[500] = "";
        model.reset(mj_loadXML(path.c_str(), nullptr, fault, sizeof fault));
        if (model == nullptr) std::puts(fault);
        data.reset(mj_makeData(model.get()));
        for (std::size_t i = 0; i < places.size(); ++i) data->qvel[6 * i] = places[i].first, data->qvel[6 * i + 2] = places[i].second;
        mj_forward(model.get(), data.get());
    }
    void step() override {
        if (model == nullptr) load();
        physvib_mujoco_step(model.get(), data.get(), world, restitution);
    }
    double height(int i) const override { return data ? data->qpos[7 * i + 2] : 0.9; }
    double speed(int i) const override { return data ? data->qvel[6 * i + (hasGravity ? 2 : 0)] : 0.0; }
    struct Free {
        void operator()(mjModel* m) const { mj_deleteModel(m); }
        void operator()(mjData* d) const { mj_deleteData(d); }
    };
    std::string xml;
    bool hasGravity = false;
    std::vector<std::pair<double, double>> places;
    std::unique_ptr<mjModel, Free> model;
    std::unique_ptr<mjData, Free> data;
};

int main() {
    MuJoCo engine;
    return scenes::run("MuJoCo", engine, false);
}
