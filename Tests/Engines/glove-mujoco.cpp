// SPDX-License-Identifier: MIT
// A hand in MuJoCo closes around a ball: who feels what when. Each finger tip is a haptic source of its part.
// Prints a table, and compares each finger's first touch with the engine's own motion.
// Usage: physvib-glove-mujoco [EVENTS.csv]
#include "Engine.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <physvib/engines/physvib_mujoco.h>
#include <sstream>
#include <string>
#include <vector>

// A hand of five fingers and a free ball as a MuJoCo model. Places are those of the field: x to the right, y
// along the fingers, z backwards, so the palm looks to smaller z. The palm is turned upwards, and the ball
// lies on it. Sizes and masses are those of an average hand, assumed.
namespace glove {

constexpr double fieldWidthMetres = 0.14, fieldHeightMetres = 0.095; ///< the extent of `glove5`
constexpr double ballRadiusMetres = 0.04, ballKg = 0.2;
constexpr std::array<double, 3> ballMetres{0.08, 0.035, -ballRadiusMetres};
constexpr double fingerRadiusMetres = 0.008;

struct Finger {
    const char* part;
    double xMetres, yMetres; ///< of its knuckle
    double aside;            ///< rad, from y towards x, of the straight finger
    double startSeconds;     ///< when it begins to close
    double liftSeconds;      ///< when it is lifted off, to tap the ball once
};

constexpr std::array<Finger, 5> fingers{{{"thumb", 0.042, 0.003, -2.3, 0.10, 1.16},
                                         {"index", 0.054, 0.076, -0.10, 0.12, 1.06},
                                         {"middle", 0.073, 0.080, 0.0, 0.18, 0.96},
                                         {"ring", 0.092, 0.078, 0.08, 0.24, 0.86},
                                         {"little", 0.110, 0.068, 0.16, 0.30, 0.76}}};

constexpr double closingSeconds = 0.3, tapSeconds = 0.2, lifted = 0.5; ///< how far: a share of closing
constexpr std::array<double, 2> openRadians{0.2, 0.25}, closedRadians{1.15, 1.55}; ///< knuckle, middle joint

/// 0 before, 1 behind, and smooth between.
inline double smooth(double share) {
    const double x = std::fmin(std::fmax(share, 0.0), 1.0);
    return x * x * (3.0 - 2.0 * x);
}

/// Where both actuators of a finger are to hold its joints then.
inline double wanted(const Finger& finger, std::size_t joint, double seconds) {
    const double since = (seconds - finger.liftSeconds) / tapSeconds;
    const double closed = smooth((seconds - finger.startSeconds) / closingSeconds) -
                          lifted * (smooth(2.0 * since) - smooth(2.0 * since - 1.0));
    return openRadians[joint] + closed * (closedRadians[joint] - openRadians[joint]);
}

/// From the field's axes to MuJoCo's.
inline std::string text(double x, double y, double z) {
    std::ostringstream to;
    to.precision(12);
    to << x << ' ' << -z << ' ' << y;
    return to.str();
}

inline std::string segment(const std::string& name, double metres, double kg) {
    std::ostringstream to;
    to << "<joint name='" << name << "' axis='0 1 0' damping='0.004' armature='1e-5'/><geom name='" << name
       << "' type='capsule' size='" << fingerRadiusMetres << "' fromto='0 0 0 " << metres << " 0 0' mass='"
       << kg << "' contype='1' conaffinity='2'/>";
    return to.str();
}

/// Two segments; the second, the tip, is a body by the name of the part.
inline std::string bodyOf(const Finger& finger) {
    const std::string name = finger.part;
    const double x = std::sin(finger.aside), y = std::cos(finger.aside);
    // the joints' axis is the finger's direction times -z: a positive angle closes the finger
    return "<body pos='" + text(finger.xMetres, finger.yMetres, 0.008) + "' xyaxes='" + text(x, y, 0) + ' ' +
           text(-y, x, 0) + "'>" + segment(name + "-knuckle", 0.045, 0.02) + "<body name='" + name +
           "' pos='0.045 0 0'>" + segment(name + "-tip", 0.035, 0.012) + "</body></body>";
}

/// The model as MuJoCo reads it.
inline std::string model(double stepSeconds) {
    std::ostringstream to;
    to << "<mujoco><compiler angle='radian'/><option timestep='" << stepSeconds << "' gravity='"
       << text(0, 0, 9.81) << "'/><worldbody><geom name='palm' type='box' pos='" << text(0.08, 0.035, 0.01)
       << "' size='0.045 0.01 0.045' contype='1' conaffinity='2'/><body name='ball' pos='"
       << text(ballMetres[0], ballMetres[1], ballMetres[2])
       << "'><freejoint/><geom name='ball' type='sphere' size='" << ballRadiusMetres << "' mass='" << ballKg
       << "' contype='2' conaffinity='1'/></body>";
    for (const Finger& finger : fingers) to << bodyOf(finger);
    to << "</worldbody><actuator>";
    for (const Finger& finger : fingers)
        for (const char* joint : {"-knuckle", "-tip"})
            to << "<position joint='" << finger.part << joint
               << "' kp='0.3' forcelimited='true' forcerange='-0.3 0.3'/>";
    to << "</actuator></mujoco>";
    return to.str();
}

} // namespace glove

namespace {

using namespace glove;

constexpr double stepSeconds = 0.002, playedSeconds = 1.5;
constexpr double mostLateSeconds = 0.0005;
constexpr double full = 0.01; ///< N s, of full scale

struct Free {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
};

struct Hand {
    std::unique_ptr<mjModel, Free> model;
    std::unique_ptr<mjData, Free> data;
    int geom(const std::string& name) const { return mj_name2id(model.get(), mjOBJ_GEOM, name.c_str()); }
    int body(const std::string& name) const { return mj_name2id(model.get(), mjOBJ_BODY, name.c_str()); }
};

Hand handOf() {
    const std::string path = "glove.xml"; // a model is a file here
    std::ofstream(path) << model(stepSeconds);
    char fault[500] = "";
    Hand hand;
    hand.model.reset(mj_loadXML(path.c_str(), nullptr, fault, sizeof fault));
    if (hand.model == nullptr) {
        std::fprintf(stderr, "%s\n", fault);
        return hand;
    }
    hand.data.reset(mj_makeData(hand.model.get()));
    for (const Finger& finger : fingers)
        for (std::size_t joint = 0; joint < 2; ++joint) {
            const std::string name = finger.part + std::string(joint == 0 ? "-knuckle" : "-tip");
            const int id = mj_name2id(hand.model.get(), mjOBJ_JOINT, name.c_str());
            hand.data->qpos[hand.model->jnt_qposadr[id]] = openRadians[joint];
        }
    mj_forward(hand.model.get(), hand.data.get());
    return hand;
}

/// The tips are felt, with the vibration of the ball, which is of wood.
physvib_world worldOf(const Hand& hand) {
    physvib_world_settings settings;
    physvib_world_settings_init(&settings, sizeof settings);
    settings.field_width_m = fieldWidthMetres;
    settings.full_scale_impulse_n_s = full;
    settings.threshold_m_per_s = 0.05;
    physvib_world world = nullptr;
    physvib_world_create(&settings, &world);
    for (int id = 0; id < hand.model->nbody; ++id) {
        physvib_body body;
        physvib_body_init(&body, sizeof body);
        body.mass_kg = hand.model->body_mass[id];
        if (id == hand.body("ball")) physvib_material("wooden board", &body);
        for (const Finger& finger : fingers)
            if (id == hand.body(finger.part))
                body.is_camera = 1, body.voice = PHYSVIB_VOICE_OTHER, body.part = physvib_part(finger.part);
        physvib_world_set_body(world, id, &body);
    }
    return world;
}

/// Between the surfaces of the ball and a finger tip, m; below 0 they overlap.
double gapOf(const Hand& hand, const Finger& finger) {
    const int tip = hand.geom(finger.part + std::string("-tip")), ball = hand.geom("ball");
    const mjtNum *at = hand.data->geom_xpos + 3 * tip, *turned = hand.data->geom_xmat + 9 * tip,
                 *centre = hand.data->geom_xpos + 3 * ball;
    const double half = hand.model->geom_size[3 * tip + 1];
    const mjtNum axis[3] = {turned[2], turned[5], turned[8]};
    mjtNum apart[3];
    mju_sub3(apart, centre, at);
    const double along = std::clamp(mju_dot3(apart, axis), -half, half);
    mju_addToScl3(apart, axis, -along);
    return mju_norm3(apart) - ballRadiusMetres - fingerRadiusMetres;
}

/// The engine's own motion of a tip: when it met the ball, each on the line between two steps.
struct Meetings {
    double gap = 1.0;
    std::vector<double> seconds;
    void behind(double now, double next) {
        if (gap > 0.0 && next <= 0.0) seconds.push_back(now - stepSeconds * next / (next - gap));
        gap = next;
    }
    /// From that time to the nearest of them.
    double from(double then) const {
        double nearest = playedSeconds;
        for (const double at : seconds) nearest = std::min(nearest, std::abs(at - then));
        return nearest;
    }
};

using HandMeetings = std::array<Meetings, fingers.size()>;

HandMeetings play(Hand& hand, physvib_world world) {
    HandMeetings meetings;
    const int steps = static_cast<int>(std::lround(playedSeconds / stepSeconds));
    for (int step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < fingers.size(); ++i)
            for (std::size_t joint = 0; joint < 2; ++joint)
                hand.data->ctrl[2 * i + joint] = wanted(fingers[i], joint, step * stepSeconds);
        if (physvib_mujoco_step(hand.model.get(), hand.data.get(), world, 0.0) != PHYSVIB_OK)
            std::fprintf(stderr, "%s\n", physvib_error());
        mj_kinematics(hand.model.get(), hand.data.get()); // places at the end of the step
        for (std::size_t i = 0; i < fingers.size(); ++i)
            meetings[i].behind((step + 1) * stepSeconds, gapOf(hand, fingers[i]));
    }
    return meetings;
}

/// A line of the table. False if the finger felt nothing, or something when it did not meet the ball.
bool row(const Finger& finger, const Meetings& meetings, const std::vector<physvib_event>& events) {
    int count = 0;
    double first = -1.0, strongest = 0.0, worst = 0.0;
    for (const physvib_event& event : events) {
        if (event.part != physvib_part(finger.part)) continue;
        const double at = static_cast<double>(event.time_ns) * 1e-9;
        if (count++ == 0) first = at;
        strongest = std::max(strongest, event.impulse_n_s);
        worst = std::max(worst, meetings.from(at));
    }
    std::printf("| %s | %.4f | %.5f | %d of %d | %.3f ms |\n", finger.part, first, strongest, count,
                static_cast<int>(meetings.seconds.size()), 1e3 * worst);
    return count > 0 && !meetings.seconds.empty() &&
           std::abs(first - meetings.seconds.front()) <= mostLateSeconds && worst <= mostLateSeconds;
}

} // namespace

int main(int count, char** words) {
    Hand hand = handOf();
    if (hand.model == nullptr) return 1;
    const physvib_world world = worldOf(hand);
    const HandMeetings meetings = play(hand, world);
    const std::vector<physvib_event> events = scenes::eventsOf(world);
    std::puts("| finger | first touch (s) | strongest (N s) | events, of meetings | worst onset |\n"
              "| --- | --- | --- | --- | --- |");
    bool isRight = true;
    for (std::size_t i = 0; i < fingers.size(); ++i) isRight &= row(fingers[i], meetings[i], events);
    if (count > 1 &&
        physvib_events_save_field(words[1], events.data(), static_cast<physvib_int64>(events.size()),
                                  fieldWidthMetres, fieldHeightMetres) != PHYSVIB_OK) {
        std::fprintf(stderr, "%s\n", physvib_error());
        return 1;
    }
    return isRight ? 0 : 1;
}
