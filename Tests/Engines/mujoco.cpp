// SPDX-License-Identifier: MIT
// MuJoCo through its adapter.
#include "Scenes.h"
#include <fstream>
#include <memory>
#include <physvib/engines/physvib_mujoco.h>
#include <sstream>
#include <string>

struct MuJoCo final : scenes::Engine {
    MuJoCo() { isRigid = false; }
    void begin(double stepSeconds, double g, double, double) override {
        std::ostringstream head;
        head << "<mujoco><option timestep='" << stepSeconds << "' gravity='0 0 " << -g << "'/><worldbody>";
        xml = head.str();
        balls.clear();
        model.reset();
    }
    // a damping that gives half of the speed back
    void floor() override { xml += "<geom type='plane' size='5 5 1' solref='0.02 0.2155'/>"; }
    void add(const scenes::Body& from) override {
        physvib_body still; // the floor is its body 0
        physvib_body_init(&still, sizeof still);
        physvib_world_set_body(world, 0, &still);
        tell(from);
        std::ostringstream body;
        body << "<body pos='" << from.x << " 0 " << from.y
             << "'><freejoint/><geom type='sphere' solref='0.02 0.2155' size='" << from.width / 2
             << "' mass='" << from.massKg << "'/></body>";
        xml += body.str();
        balls.push_back(from);
    }
    void load() { // a world is a file here
        const std::string path = "engine.xml";
        std::ofstream(path) << xml << "</worldbody></mujoco>";
        char fault[500] = "";
        model.reset(mj_loadXML(path.c_str(), nullptr, fault, sizeof fault));
        if (model == nullptr) std::puts(fault);
        data.reset(mj_makeData(model.get()));
        for (std::size_t i = 0; i < balls.size(); ++i)
            data->qvel[6 * i] = balls[i].vx, data->qvel[6 * i + 2] = balls[i].vy;
        mj_forward(model.get(), data.get());
    }
    void step() override {
        if (model == nullptr) load();
        physvib_mujoco_step(model.get(), data.get(), world, restitution);
    }
    scenes::Motion motion(int body) const override {
        const auto i = static_cast<std::size_t>(body) - 1;
        if (!data) return {balls[i].x, balls[i].y, 0.0, 0.0, 0.0};
        return {data->qpos[7 * i], data->qpos[7 * i + 2], data->qvel[6 * i], data->qvel[6 * i + 2], 0.0};
    }
    struct Free {
        void operator()(mjModel* m) const { mj_deleteModel(m); }
        void operator()(mjData* d) const { mj_deleteData(d); }
    };
    std::string xml;
    std::vector<scenes::Body> balls;
    std::unique_ptr<mjModel, Free> model;
    std::unique_ptr<mjData, Free> data;
};

int main(int count, char** words) {
    MuJoCo engine;
    return scenes::run("MuJoCo", engine, count, words);
}
