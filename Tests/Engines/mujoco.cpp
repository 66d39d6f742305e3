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
    MuJoCo() { isRigid = false, verbs = "put fling mass gravity passes"; }
    void begin(double stepSeconds, double g, double e, double mu) override {
        std::ostringstream head, how;
        head.precision(12);
        head << "<mujoco><option timestep='" << stepSeconds << "' gravity='0 0 " << -g << "'/><worldbody>";
        // a damping that gives that part of the speed back, or MuJoCo's default, which gives nothing back
        const double log = std::log(e > 0 ? e : 1e-9);
        how << " condim='3' friction='" << mu << " 0.005 0.0001' solref='0.02 "
            << (e > 0 ? -log / std::hypot(3.14159265358979, log) : 1.0) << "'";
        xml = head.str(), surface = how.str(), joints = "";
        dt = stepSeconds, restitution = e;
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
        if (from.moves()) // the two ways and the turn of a plane
            body << "<joint type='slide' axis='" << std::cos(from.angle) << " 0 " << -std::sin(from.angle)
                 << "'/><joint type='slide' axis='" << std::sin(from.angle) << " 0 " << std::cos(from.angle)
                 << "'/>" << (from.turns ? "<joint axis='0 -1 0'/>" : "");
        body << "<geom type='" << (from.isBox ? "box" : "sphere") << "' size='" << from.width / 2;
        if (from.isBox) body << " 0.05 " << from.height / 2;
        body << "' mass='" << from.massKg << "'" << surface << "/>";
        if (from.moves())
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
        for (std::size_t i = 0; i < bodies.size(); ++i)
            if (bodies[i].moves()) fling(i, bodies[i].vx, bodies[i].vy, bodies[i].spin);
        mj_forward(model.get(), data.get());
    }
    int joint(std::size_t body) const { return model->body_jntadr[body + 1]; }
    void fling(std::size_t body, double vx, double vy, double spin) {
        mjtNum* const v = data->qvel + joint(body);
        v[0] = vx, v[1] = vy;
        if (bodies[body].turns) v[2] = spin;
    }
    void step() override {
        if (model == nullptr) load();
        const int count = static_cast<int>(std::ceil(dt / longest - 1e-9));
        model->opt.timestep = dt / count;
        for (int i = 0; i < count; ++i)
            (isPlane ? physvib_mujoco_step_in_plane : physvib_mujoco_step)(model.get(), data.get(), world,
                                                                           restitution);
    }
    void act(const std::string& verb, int id, double x, double y, double z) override {
        if (model == nullptr) load();
        if (verb == "gravity") return void(model->opt.gravity[2] = -x);
        const std::size_t i = static_cast<std::size_t>(id) - 1;
        scenes::Body& body = bodies[i];
        if (verb == "put" && body.moves())
            data->qpos[joint(i)] = x - body.x, data->qpos[joint(i) + 1] = y - body.y;
        else if (verb == "put")
            model->body_pos[3 * id] = body.x = x, model->body_pos[3 * id + 2] = body.y = y;
        if (verb == "fling" && body.moves()) fling(i, x, y, z);
        if (verb == "passes") {
            const int geom = model->body_geomadr[id];
            model->geom_contype[geom] = model->geom_conaffinity[geom] = x != 0 ? 0 : 1;
        }
        if (verb != "mass") return;
        for (int k = 0; k < 3; ++k) model->body_inertia[3 * id + k] *= x / model->body_mass[id];
        model->body_mass[id] = x;
        const std::vector<mjtNum> at(data->qpos, data->qpos + model->nq); // which the next call sets anew
        mj_setConst(model.get(), data.get());
        std::copy(at.begin(), at.end(), data->qpos);
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
        if (!body.moves()) return {body.x, body.y, 0, 0, 0, body.angle};
        const mjtNum *at = data->qpos + joint(i), *v = data->qvel + joint(i);
        return {body.x + at[0], body.y + at[1],        v[0],
                v[1],           body.turns ? v[2] : 0, body.angle + (body.turns ? at[2] : 0)};
    }
    struct Free {
        void operator()(mjModel* m) const { mj_deleteModel(m); }
        void operator()(mjData* d) const { mj_deleteData(d); }
    };
    bool isPlane = false;
    double longest = 1.0; ///< s, of a step; longer ones are several
    std::string xml, surface, joints;
    std::vector<scenes::Body> bodies;
    std::unique_ptr<mjModel, Free> model;
    std::unique_ptr<mjData, Free> data;
};

int main(int count, char** words) {
    MuJoCo engine;
    engine.isPlane = scenes::isPlane(count, words);
    if (count > 1 && std::string_view{words[1]} == "--kit") engine.longest = 0.002;
    return scenes::run("MuJoCo", engine, count - (engine.isPlane ? 1 : 0), words + (engine.isPlane ? 1 : 0));
}
