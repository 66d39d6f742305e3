// SPDX-License-Identifier: MIT
// A folder of .haptic files with every feature, through .ahap and back: each transient stays what it was.
#include "Formats/ClipFile.h"
#include "Formats/EnvelopeFile.h"
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

namespace physvib::phone_chain_test {

using nlohmann::json;

/// Envelopes from nothing to full scale, steps, points at one time, late beginnings, emphasis everywhere.
class HapticFolder {
public:
    static constexpr int files = 64;

    HapticFolder()
        : folder_{std::filesystem::path(testing::TempDir()) /
                  (std::string{"haptic-chain-"} +
                   testing::UnitTest::GetInstance()->current_test_info()->name())} {
        std::filesystem::create_directories(folder_);
        for (int k = 0; k < files; ++k) std::ofstream{path(k)} << fileOf(k).dump();
    }
    ~HapticFolder() { std::filesystem::remove_all(folder_); }
    std::filesystem::path path(int k) const { return folder_ / (std::to_string(k) + ".haptic"); }

private:
    json fileOf(int k) {
        json envelopes{{"amplitude", amplitudesOf(k)}};
        if (k % 4 == 1) envelopes["frequency"] = nullptr;
        if (k % 4 >= 2) envelopes["frequency"] = frequenciesOf(envelopes["amplitude"], k % 4 == 3);
        json metadata{
            {"editor", "made"}, {"tags", json::array()}, {"description", "chain " + std::to_string(k)}};
        return {{"version", {{"major", 1}, {"minor", 0}, {"patch", 0}}},
                {"metadata", metadata},
                {"signals", {{"continuous", {{"envelopes", envelopes}}}}}};
    }

    json amplitudesOf(int k) {
        constexpr std::array gaps{1e-5, 0.0004, 0.002, 0.011,
                                  0.05, 0.3,    20.0}; // closer and longer than transients
        constexpr std::array scales{0.0, 1e-4, 0.01, 0.1, 1.0};
        json list = json::array();
        double time = k % 3 == 0 ? 0.0 : share();
        double held = share();
        const int points = 2 + static_cast<int>(random_() % 60); // more than the 16 of a curve
        for (int i = 0; i < points; ++i) {
            if (random_() % 3) held = share() * scales[random_() % scales.size()];
            json point{{"time", time}, {"amplitude", held}};
            if (random_() % 2)
                point["emphasis"] = {{"amplitude", std::min(1.0, 0.01 + held + (1.0 - held) * share())},
                                     {"frequency", share()}};
            else if (random_() % 4 == 0)
                point["emphasis"] = nullptr;
            list.push_back(point);
            if (random_() % 8 || i + 2 == points)
                time += gaps[random_() % (random_() % 32 ? gaps.size() - 1 : gaps.size())] *
                        (0.5 + share()); // else a step
        }
        return list;
    }

    json frequenciesOf(const json& amplitudes, bool isLate) {
        const double begin = amplitudes.front()["time"], end = amplitudes.back()["time"];
        json list = json::array();
        for (double s = isLate ? 0.3 : 0.0; s <= 1.0; s += 0.2)
            list.push_back({{"time", std::lerp(begin, end, s)}, {"frequency", share()}});
        return list;
    }

    double share() { return static_cast<double>(random_()) / 4294967296.0; }

    std::filesystem::path folder_;
    std::mt19937 random_{35};
};

Clip through(const Clip& clip, ClipFormat format) {
    auto again = readClip(clipBytes(clip, format), "f", format);
    EXPECT_EQ(again.error, "");
    return std::move(again.value);
}

double decibels(double a, double b) { return std::abs(20.0 * std::log10(a / b)); }

/// One to one, in time order; transients of one moment in any.
void expectSame(const std::vector<ClipTransient>& was, std::vector<ClipTransient> is,
                const std::string& what) {
    ASSERT_EQ(is.size(), was.size()) << what;
    for (const ClipTransient& t : was) {
        const auto found = std::ranges::find_if(is, [&](const ClipTransient& other) {
            return std::abs(other.seconds - t.seconds) <= 1e-3 &&
                   decibels(other.amplitude, t.amplitude) <= 1.0 &&
                   std::abs(other.frequencyHz - t.frequencyHz) < 1.0;
        });
        ASSERT_NE(found, is.end()) << what << ": " << t.amplitude << " at " << t.seconds << " s";
        is.erase(found);
    }
}

TEST(PhoneChain, KeepsEveryTransientWithinADecibelAndAMillisecond) {
    HapticFolder folder;
    std::size_t transients = 0;
    for (int k = 0; k < HapticFolder::files; ++k) {
        const auto clip = loadClip(folder.path(k), ClipFormat::haptic);
        ASSERT_EQ(clip.error, "");
        const std::vector<ClipTransient>& was = clip.value.channels[0].transients;
        const Clip apple = through(clip.value, ClipFormat::ahap), meta = through(apple, ClipFormat::haptic);
        const std::string name = folder.path(k).filename().string();
        expectSame(was, apple.channels[0].transients, name + " as .ahap");
        expectSame(was, meta.channels[0].transients, name + " as .haptic again");
        transients += was.size();
    }
    EXPECT_GT(transients, 500u);
}

/// The least and the most of the envelope within a millisecond of `at`.
std::array<double, 2> around(const std::vector<EnvelopePoint>& envelope, double at) {
    std::array<double, 2> range{1e9, 0.0};
    for (const EnvelopePoint& p : envelopeSlice(envelope, std::max(0.0, at - 1e-3), at + 1e-3))
        range = {std::min(range[0], p.amplitude), std::max(range[1], p.amplitude)};
    return range;
}

TEST(PhoneChain, KeepsTheEnvelopeBesideTransients) {
    HapticFolder folder;
    for (int k = 0; k < HapticFolder::files; ++k) {
        const auto clip = loadClip(folder.path(k), ClipFormat::haptic);
        const auto was = makeEnvelope(clip.value.channels[0]),
                   is = makeEnvelope(through(clip.value, ClipFormat::ahap).channels[0]);
        for (double t = 0.0; t < std::min(5.0, clip.value.seconds()); t += 0.0007) {
            const auto [least, most] = around(was, t);
            const double found = envelopeAt(is, t).amplitude;
            ASSERT_TRUE(found >= least - 0.01 && found <= most + 0.01)
                << folder.path(k) << ": " << found << " at " << t << " s, expected " << least << " to "
                << most;
        }
    }
}

/// What Apple's files say at a moment: the last value of a curve of that parameter.
double controlAt(const json& pattern, const char* parameter, double time, double before) {
    double value = before, begun = -1.0;
    for (const json& entry : pattern) {
        if (!entry.contains("ParameterCurve") || entry["ParameterCurve"]["ParameterID"] != parameter)
            continue;
        const json& curve = entry["ParameterCurve"];
        const double start = curve["Time"];
        if (start > time + 1e-9 || start < begun) continue;
        begun = start;
        std::vector<ClipPoint> points;
        for (const json& p : curve["ParameterCurveControlPoints"])
            points.push_back({start + p["Time"].get<double>(), p["ParameterValue"]});
        value = valueAt(points, time + 1e-9);
    }
    return value;
}

TEST(PhoneChain, CurvesAreNeutralAtATransientAndHaveAtMostSixteenPoints) {
    HapticFolder folder;
    for (int k = 0; k < HapticFolder::files; ++k) {
        const auto clip = loadClip(folder.path(k), ClipFormat::haptic);
        const json pattern = json::parse(ahapText(clip.value.channels[0], ""))["Pattern"];
        for (const json& entry : pattern) {
            if (entry.contains("ParameterCurve"))
                ASSERT_LE(entry["ParameterCurve"]["ParameterCurveControlPoints"].size(), 16u);
            if (!entry.contains("Event") || entry["Event"]["EventType"] != "HapticTransient") continue;
            const double time = entry["Event"]["Time"];
            for (const double at : {time - 5e-8, time, time + 5e-8}) { // where curves meet, programs differ
                ASSERT_NEAR(controlAt(pattern, "HapticIntensityControl", std::max(0.0, at), 1.0), 1.0, 0.03)
                    << folder.path(k) << " at " << time;
                ASSERT_NEAR(controlAt(pattern, "HapticSharpnessControl", std::max(0.0, at), 0.0), 0.0, 0.03)
                    << folder.path(k) << " at " << time;
            }
        }
    }
}

} // namespace physvib::phone_chain_test
