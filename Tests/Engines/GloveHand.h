// SPDX-License-Identifier: MIT
// A hand of five fingers and a free ball as a MuJoCo model. Places are those of the field: x to the right, y
// along the fingers, z backwards, so the palm looks to smaller z. The palm is turned upwards, and the ball
// lies on it. Sizes and masses are those of an average hand, assumed.
#pragma once
#include <array>
#include <cmath>
#include <sstream>
#include <string>

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
