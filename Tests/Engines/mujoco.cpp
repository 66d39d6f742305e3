// SPDX-License-Identifier: MIT
// MuJoCo through its adapter. Its bodies are numbered by the order in which they are added.
#include "Scenes.h"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <physvib/engines/physvib_mujoco.h>
#include <sstream>
#include <string>

struct MuJoCo final : scenes::Engine {
    MuJoCo() { isRigid = false; }
    void begin(double stepSeconds, double g, double e, double mu) override {
        std::ostringstream head, how;
        head.precision(12);
        head << "<mujoco><option timestep='" << stepSeconds << "' gravity='0 0 " << -g << "'/><worldbody>";
        // a damping that gives half of the speed back, or MuJoCo's default, which gives nothing back
        how << " condim='3' friction='" << mu << " 0.005 0.0001' solref='0.02 " << (e > 0 ? "0.2155'" : "1'");
        xml = head.str(), surface = how.str(), joints = "";
        restitution = e;
        bodies.clear();
        model.reset();
    }
    void floor() override { xml += "<geom type='plane' size='20 5 1'" + surface + "/>"; }
    void add(const scenes::Body& from) override {
        physvib_body still; // the floor is its body 0
        physvib_body_init(&still, sizeof still);
        physvib_world_set_body(world, 0, &still);
        scenes::Body numbered = from;
        numbered.id = static_cast<int>(bodies.size()) + 1;
        tell(numbered);
        bodies.push_back(from);
        std::ostringstream body;
        body.precision(12);
        body << "<body name='" << from.id << "' pos='" << from.x << " 0 " << from.y << "' euler='0 "
             << -from.angle * 180.0 / 3.14159265358979 << " 0'>";
        if (from.massKg > 0) // the two ways and the turn of a plane
            body << "<joint type='slide' axis='" << std::cos(from.angle) << " 0 " << -std::sin(from.angle)
                 << "'/><joint type='slide' axis='" << std::sin(from.angle) << " 0 " << std::cos(from.angle)
                 << "'/><joint axis='0 -1 0'/>";
        body << "<geom type='" << (from.isBox ? "box" : "sphere") << "' size='" << from.width / 2;
        if (from.isBox) body << " 0.05 " << from.height / 2;
        body << "' mass='" << from.massKg << "'" << surface << "/>";
        if (from.massKg > 0)
            body << "<inertial pos='0 0 0' mass='" << from.massKg << "' diaginertia='" << from.inertia()
                 << " " << from.inertia() << " " << from.inertia() << "'/>";
        xml += body.str() + "</body>";
    }
    void pin(int a, int b, double x, double y) override {
        const scenes::Body& first = *std::find_if(bodies.begin(), bodies.end(),
                                                  [a](const scenes::Body& body) { return body.id == a; });
        const double dx = x - first.x, dy = y - first.y, c = std::cos(first.angle), s = std::sin(first.angle);
        std::ostringstream joint;
        joint.precision(12);
        joint << "<connect body1='" << a << "' ";
        if (b > 0) joint << "body2='" << b << "' ";
        joint << "anchor='" << c * dx + s * dy << " 0 " << c * dy - s * dx << "' solref='0.0084 1'/>";
        joints += joint.str();
    }
    void load() { // a world is a file here
        const std::string path = "engine.xml";
        std::ofstream(path) << xml << "</worldbody><equality>" << joints << "</equality></mujoco>";
        char fault[500] = "";
        model.reset(mj_loadXML(path.c_str(), nullptr, fault, sizeof fault));
        if (model == nullptr) std::puts(fault);
        data.reset(mj_makeData(model.get()));
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (!(bodies[i].massKg > 0)) continue;
            mjtNum* const v = data->qvel + joint(i);
            v[0] = bodies[i].vx, v[1] = bodies[i].vy, v[2] = bodies[i].spin;
        }
        mj_forward(model.get(), data.get());
    }
    int joint(std::size_t body) const { return model->body_jntadr[body + 1]; }
    void step() override {
        if (model == nullptr) load();
        (isPlane ? physvib_mujoco_step_in_plane : physvib_mujoco_step)(model.get(), data.get(), world,
                                                                       restitution);
    }
    std::vector<physvib_event> take() override {
        const auto number = [this](int id) {
            return id > 0 ? bodies[static_cast<std::size_t>(id) - 1].id : scenes::floorBody;
        };
        std::vector<physvib_event> events = Engine::take();
        for (physvib_event& event : events)
            event.fixture = number(event.fixture), event.other = number(event.other);
        return events;
    }
    scenes::Motion motion(int id) const override {
        std::size_t i = 0;
        while (bodies[i].id != id) ++i;
        const scenes::Body& body = bodies[i];
        if (!model) return {body.x, body.y, body.vx, body.vy, body.spin, body.angle};
        const mjtNum *at = data->qpos + joint(i), *v = data->qvel + joint(i);
        return {body.x + at[0], body.y + at[1], v[0], v[1], v[2], body.angle + at[2]};
    }
    struct Free {
        void operator()(mjModel* m) const { mj_deleteModel(m); }
        void operator()(mjData* d) const { mj_deleteData(d); }
    };
    bool isPlane = false;
    std::string xml, surface, joints;
    std::vector<scenes::Body> bodies;
    std::unique_ptr<mjModel, Free> model;
    std::unique_ptr<mjData, Free> data;
};

int main(int count, char** words) {
    MuJoCo engine;
    engine.isPlane = scenes::isPlane(count, words);
    return scenes::run("MuJoCo", engine, count - (engine.isPlane ? 1 : 0), words + (engine.isPlane ? 1 : 0));
}
