// SPDX-License-Identifier: GPL-3.0-or-later
// Beats of a song whose onsets are known.
#include "Host/Music/BeatDetector.h"
#include "Support/BeatSong.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace physvib::beat_detector_test {

using test::BeatSong;
using test::Drum;

std::vector<BandOnset> onsetsOf(BeatDetector& detector, std::span<const float> samples,
                                std::size_t piece = 4096) {
    std::vector<BandOnset> onsets;
    for (std::size_t at = 0; at < samples.size(); at += piece)
        detector.process(samples.subspan(at, std::min(piece, samples.size() - at)),
                         [&](const BandOnset& onset) { onsets.push_back(onset); });
    return onsets;
}

struct Score {
    std::size_t hits = 0, found = 0, strange = 0;
    double medianSeconds = 0.0;
};

/// Of the hits of these drums, those found in the band, or (-1) in any, within 10 ms; and onsets 30 ms and
/// more from any hit.
Score scoreOf(const std::vector<BandOnset>& onsets, const BeatSong& song, int rateHz, int band,
              const std::vector<Drum>& drums) {
    Score score;
    std::vector<double> errors;
    const auto isOf = [&](const BandOnset& onset) { return band < 0 || onset.band == band; };
    const auto errorOf = [&](const BandOnset& onset, const test::DrumHit& hit) {
        return static_cast<double>(onset.frame) / rateHz - hit.seconds;
    };
    for (const auto& hit : song.hits) {
        if (std::ranges::find(drums, hit.drum) == drums.end()) continue;
        ++score.hits;
        double nearest = 1.0;
        for (const BandOnset& onset : onsets)
            if (isOf(onset) && std::abs(errorOf(onset, hit)) < std::abs(nearest))
                nearest = errorOf(onset, hit);
        score.found += std::abs(nearest) <= 0.01 ? 1 : 0;
        errors.push_back(nearest);
    }
    for (const BandOnset& onset : onsets)
        score.strange += isOf(onset) && std::ranges::none_of(song.hits,
                                                             [&](const auto& hit) {
                                                                 return std::abs(errorOf(onset, hit)) < 0.03;
                                                             })
                             ? 1
                             : 0;
    std::ranges::nth_element(errors, errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2));
    score.medianSeconds = errors[errors.size() / 2];
    return score;
}

TEST(BeatDetector, FindsTheBeatsOfASongWithinTenMilliseconds) {
    for (const int rateHz : {22050, 44100, 48000}) {
        const BeatSong song{12.0, rateHz, 7};
        BeatDetector detector{rateHz};
        const auto onsets = onsetsOf(detector, song.samples);
        const Score all = scoreOf(onsets, song, rateHz, -1, {Drum::kick, Drum::snare, Drum::hat});
        EXPECT_GE(all.found * 100, all.hits * 95) << rateHz;
        EXPECT_LE(all.strange * 100, onsets.size() * 5) << rateHz;
        const Score kicks = scoreOf(onsets, song, rateHz, 0, {Drum::kick}),
                    snares = scoreOf(onsets, song, rateHz, 1, {Drum::snare}),
                    hats = scoreOf(onsets, song, rateHz, 2, {Drum::snare, Drum::hat});
        for (const Score& score : {kicks, snares, hats}) {
            EXPECT_GE(score.found * 100, score.hits * 90) << rateHz;
            // the detector's own delay is made up for
            EXPECT_LT(std::abs(score.medianSeconds), 0.001) << rateHz;
        }
    }
}

TEST(BeatDetector, TellsTheSameInPiecesOfAnySizeAndAfterAReset) {
    const BeatSong song{4.0, 48000, 3};
    BeatDetector detector{48000};
    const auto whole = onsetsOf(detector, song.samples, song.samples.size());
    EXPECT_GT(whole.size(), 10u);
    for (const std::size_t piece : {1u, 37u, 512u, 8192u}) {
        detector.reset();
        EXPECT_EQ(onsetsOf(detector, song.samples, piece), whole) << piece;
    }
}

// Whoever starts a song again, wherever the one before was left and however loud that was.
TEST(BeatDetector, AResetForgetsAllThatWasHeard) {
    constexpr int rateHz = 22050;
    const BeatSong before{2.1, rateHz, 3}, after{2.1, rateHz, 5};
    // from just before its first beat on
    std::vector<float> quiet(after.samples.begin() + 10'600, after.samples.begin() + 28'000);
    for (float& x : quiet) x *= 0.1f;
    BeatDetector fresh{rateHz}, again{rateHz};
    const auto whole = onsetsOf(fresh, quiet);
    EXPECT_GT(whole.size(), 2u);
    for (const auto& hit : before.hits) {
        onsetsOf(again,
                 std::span{before.samples}.first(static_cast<std::size_t>((hit.seconds + 0.04) * rateHz)));
        again.reset();
        EXPECT_EQ(onsetsOf(again, quiet), whole) << "left after the beat at " << hit.seconds << " s";
    }
}

TEST(BeatDetector, TellsEachWithinItsDelay) {
    for (const int rateHz : {5000, 44100, 95000, 192000}) {
        const BeatSong song{3.0, rateHz, 3};
        BeatDetector detector{rateHz};
        EXPECT_LE(static_cast<double>(detector.delayFrames()), BeatDetector::maxDelaySeconds * rateHz);
        std::int64_t taken = 0, told = 0;
        for (const float sample : song.samples) {
            ++taken;
            detector.process({&sample, 1}, [&](const BandOnset& onset) {
                ++told;
                EXPECT_LE(taken - onset.frame, detector.delayFrames()) << rateHz;
                EXPECT_GE(taken, onset.frame) << rateHz;
            });
        }
        EXPECT_GT(told, 3) << rateHz;
    }
}

TEST(BeatDetector, HearsNothingInSilenceOrInWhatStays) {
    BeatDetector detector{48000};
    std::vector<float> tone(96000);
    for (std::size_t i = 0; i < tone.size(); ++i)
        tone[i] = 0.5f * static_cast<float>(std::sin(0.0288 * static_cast<double>(i)));
    EXPECT_EQ(onsetsOf(detector, std::vector<float>(48000)).size(), 0u);
    EXPECT_LE(onsetsOf(detector, tone).size(), beatBands.size()); // where it begins
    EXPECT_LE(onsetsOf(detector, tone).size(), beatBands.size()); // where it steps
}

TEST(BeatDetector, ASensitiveOneHearsMore) {
    const BeatSong song{8.0, 48000, 5};
    BeatDetector dull{48000, 0.0}, usual{48000}, sharp{48000, 1.0};
    const auto few = onsetsOf(dull, song.samples).size(), some = onsetsOf(usual, song.samples).size(),
               many = onsetsOf(sharp, song.samples).size();
    EXPECT_LT(few, some);
    EXPECT_LT(some, many);
}

TEST(BeatStrikes, GoToTheEnchantersOfTheirBand) {
    const auto setsOf = [](int count) {
        std::string words;
        for (const ActuatorSet& set : defaultBeatActuators(count)) {
            for (std::size_t j = 0; j < set.size(); ++j)
                if (set[j]) words += static_cast<char>('A' + j);
            words += ' ';
        }
        return words;
    };
    EXPECT_EQ(setsOf(1), "A A A ");
    EXPECT_EQ(setsOf(2), "A B B ");
    EXPECT_EQ(setsOf(3), "A B C ");
    EXPECT_EQ(setsOf(5), "A BCD E ");
    ActuatorSet chosen;
    EXPECT_TRUE(parseActuatorLetters("DA", 4, chosen));
    EXPECT_EQ(chosen.to_ullong(), 9u);
    for (const char* wrong : {"E", "AA", "a", "1"})
        EXPECT_FALSE(parseActuatorLetters(wrong, 4, chosen)) << wrong;
    ActuatorLayout layout;
    ASSERT_TRUE(layoutPreset("phone4", layout));
    BeatVoices voices;
    voices.actuators = defaultBeatActuators(4);
    std::vector<CollisionEvent> strikes;
    makeBeatEvents({480, 1, 0.5}, 10'000'000, voices, layout, 2.0, 1.0,
                   [&](const CollisionEvent& e) { strikes.push_back(e); });
    ASSERT_EQ(strikes.size(), 2u); // B upper right, C lower left
    EXPECT_EQ(std::pair(strikes[0].x, strikes[0].y), std::pair(2.0, 1.0));
    EXPECT_EQ(std::pair(strikes[1].x, strikes[1].y), std::pair(0.0, 0.0));
    EXPECT_EQ(strikes[0].amplitude, 0.25);
    EXPECT_TRUE(isPlayable(strikes[0]));
}

TEST(BandPass, PassesItsBandAndNothingElse) {
    const auto gainAt = [](double hz) {
        BandPass pass{BandPass::defaultBand, 48000};
        std::vector<float> tone(48000);
        for (std::size_t i = 0; i < tone.size(); ++i)
            tone[i] =
                static_cast<float>(std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(i) / 48000.0));
        pass.process(tone);
        return std::ranges::max(std::span{tone}.subspan(24000));
    };
    EXPECT_NEAR(gainAt(160.0), 1.0f, 0.01f);
    EXPECT_NEAR(gainAt(50.0), 0.7071f, 0.01f);
    EXPECT_NEAR(gainAt(500.0), 0.7071f, 0.01f);
    EXPECT_LT(gainAt(12.5), 0.005f); // 48 dB in two octaves
    EXPECT_LT(gainAt(2000.0), 0.005f);
}

} // namespace physvib::beat_detector_test
