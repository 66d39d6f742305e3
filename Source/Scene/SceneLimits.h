// SPDX-License-Identifier: MIT
// Valid ranges of a scene's values, wider than practical scenes need but within what Box2D's float arithmetic
// handles; and limits of files, each with its reason.
#pragma once
#include <cstddef>
#include <cstdint>

namespace physvib::sceneLimits {
constexpr double minSizeMetres = 0.01; // Box2D's own tolerance is 5 mm
constexpr double maxSizeMetres = 100.0;
constexpr double maxPositionMetres = 1000.0;
constexpr double maxAngleRadians = 1000.0;
constexpr double minDensityKgPerSquareMetre = 0.001;
constexpr double maxDensityKgPerSquareMetre = 100'000.0;
constexpr double maxFriction = 100.0;
constexpr double minMassKg = 1.0e-6;
constexpr double maxMassKg = 1.0e9;
constexpr double maxSpeedMetresPerSecond = 1000.0; // Box2D limits motion to 2 m per step anyway
constexpr double maxSpinRadiansPerSecond = 1000.0;
constexpr double maxDampingPerSecond = 1000.0;
constexpr double maxAccelerationMetresPerSecond2 = 1000.0;
constexpr double maxGravityFactor = 10.0;
constexpr double maxImpulseNewtonSeconds = 1.0e9;
constexpr double maxGripMetresPerSecond2 = 100.0; // force per mass: ten times the weight
constexpr double maxTorqueNewtonMetres = 1.0e9;
constexpr double maxForceNewtons = 1.0e9;
constexpr double maxSpringHz = 1000.0;
constexpr double maxDampingRatio = 100.0;
constexpr double minScriptPeriodSeconds = 0.01;
constexpr double maxScriptSeconds = 86'400.0;
constexpr double maxLiveSeconds = 1'000'000.0; // 11.6 days: a double still resolves nanoseconds
constexpr double maxDriveGain = 1.0e6;
constexpr double minNormalisation = 1.0e-6; // s/m
constexpr double maxNormalisation = 1.0e6;
constexpr double minWarnMetres = 0.1; // Box2D's manual: moving shapes of 0.1 to 10 m behave best
constexpr double maxWarnMetres = 10.0;

constexpr std::size_t maxMaterials = 256;
constexpr std::size_t maxBodies = 4096; // including the script's: four times the measured maximum
constexpr std::size_t maxFixturesPerBody = 64;
constexpr std::size_t maxFixtures = 8192;     // of the whole scene
constexpr std::size_t maxPolygonVertices = 8; // b2_maxPolygonVertices
constexpr std::size_t maxChainVertices = 1024;
constexpr std::size_t maxChainEdges = 16'384; // of the whole scene: each has an entry in Box2D's tree
constexpr int maxContacts = 50'000;           // at once; a heap of maxBodies has twenty thousand
constexpr std::size_t maxJoints = 4096;
constexpr std::size_t maxInputs = 4096;
constexpr std::size_t maxActions = 100'000;    // inputs with their repetitions
constexpr std::size_t maxLiveInputs = 100'000; // a quarter of an hour of dragging at 100 a second
constexpr double minSoundHz = 1.0;             // after a live change a sound must still be perceptible
constexpr double minSoundDecayPerSecond = 0.01;
} // namespace physvib::sceneLimits

namespace physvib::limits {
constexpr std::size_t maxEventRows = 10'000'000;          // 100 s at 10^5 events per second; 1 GB of events
constexpr std::size_t maxEventsFileBytes = 2'000'000'000; // for maxEventRows rows of usually 160 bytes
constexpr std::size_t maxLayoutFileBytes = 1'000'000;     // 64 actuators need about 10 kB
constexpr std::size_t maxSceneFileBytes = 4'000'000;      // 4096 bodies of two fixtures fill about half of it
constexpr std::size_t maxSessionFileBytes = 64'000'000;   // 100,000 inputs of a hundred bytes, and scenes
constexpr std::size_t maxSessionBodies = 1'000'000; // of all scene runs of a session, each checked and built:
                                                    // 250 starts of the largest scene
constexpr std::int64_t maxSessionNs = 1'000'000'000'000'000; // 11.6 days: the largest time that a double in a
                                                             // file resolves to the nanosecond
constexpr std::size_t maxMaterialsFileBytes = 1'000'000;     // 256 materials fill about 40 kB
constexpr std::size_t maxActuatorFileBytes = 100'000;        // a profile fills less than 1 kB
constexpr std::size_t maxPadFileBytes = 100'000;             // like an actuator's
constexpr std::size_t maxRecordingSets = 1024;               // distinct sets of a session; each is resampled
constexpr std::size_t maxVariables = 16;                     // of a scene; a study has three
constexpr std::size_t maxChoices = 64;                       // of a variable
constexpr double minExtentMetres = 1e-3, maxExtentMetres = 1e6; // of layouts and fields
constexpr double minFullScaleG = 1e-6, maxFullScaleG = 1e6;     // of an actuator
constexpr double minQ = 0.05, maxQ = 1000.0;                    // of a resonance
constexpr double minMeasuredHz = 1.0; // of actuators; the maximum is limits::maxFrequencyHz
} // namespace physvib::limits
