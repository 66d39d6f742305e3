// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib render --movie`: its pictures and their times, read from the file itself; ffmpeg by a stand-in
// that tells how it was called.
#include "CommandLine/Calls.h"
#include "Core/EventShaping.h"
#include "Pictures/RenderMovie.h"
#include <array>
#include <cstdint>
#include <vector>

namespace physvib::test {
namespace {

using MovieCommand = CommandLine;

std::uint32_t little(const std::string& bytes, std::size_t at, int count) {
    std::uint32_t value = 0;
    for (int i = count - 1; i >= 0; --i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
    return value;
}

struct Animation {
    std::uint32_t width = 0, height = 0, durationMs = 0;
    std::size_t frames = 0;
    double share = 0.0; ///< of the whole picture that frames change, on average
};

/// What the chunks of an animated WebP say.
Animation animationOf(const std::string& webp) {
    Animation found;
    if (webp.size() < 30 || webp.substr(0, 4) != "RIFF" || webp.substr(8, 8) != "WEBPVP8X") return found;
    found.width = 1 + little(webp, 24, 3), found.height = 1 + little(webp, 27, 3);
    for (std::size_t at = 12; at + 24 < webp.size();
         at += 8 + little(webp, at + 4, 4) + (little(webp, at + 4, 4) & 1u)) {
        if (webp.substr(at, 4) != "ANMF") continue;
        ++found.frames;
        found.durationMs += little(webp, at + 20, 3);
        found.share +=
            (1.0 + little(webp, at + 14, 3)) * (1.0 + little(webp, at + 17, 3)) / found.width / found.height;
    }
    found.share /= static_cast<double>(std::max<std::size_t>(found.frames, 1));
    return found;
}

TEST(RenderMovie, EachActuatorShinesByWhatItPlays) {
    constexpr int rateHz = 8000;
    PictureInput input;
    input.fieldWidthMetres = input.layout.extentWidthMetres = 0.14;
    input.fieldHeightMetres = input.layout.extentHeightMetres = 0.07;
    input.layout.count = 2;
    input.layout.places[0] = {0.02, 0.03};
    input.layout.places[1] = {0.12, 0.03};
    input.sampleRateHz = rateHz;
    input.durationSeconds = 1.0;
    const std::vector<float> silence(rateHz), loud(rateHz, 0.5f);
    const std::array<std::array<const float*, 2>, 3> played{
        {{silence.data(), silence.data()}, {loud.data(), silence.data()}, {silence.data(), loud.data()}}};
    std::vector<picture::Image> images;
    for (const auto& block : played) {
        WaveformEnvelope waveform(2, 0, rateHz);
        waveform.add(block.data(), rateHz);
        input.waveform = &waveform;
        images.push_back(RenderMovie{input}.draw(500'000'000, {}));
    }
    std::array<double, 3> centre{};
    for (const std::size_t which : {1u, 2u}) {
        double sum = 0.0, count = 0.0;
        for (int y = 60; y < RenderMovie::height / 2; ++y) // the world, not the lanes below it
            for (int x = 0; x < RenderMovie::width; ++x)
                if (images[which].at(x, y) != images[0].at(x, y)) sum += x, ++count;
        ASSERT_GT(count, 100.0) << which;
        centre[which] = sum / count;
    }
    EXPECT_LT(centre[1] + 100.0, centre[2]);
}

TEST(RenderMovie, AnotherSceneIsDrawnAsInAMovieOfItsOwn) {
    const auto box = [](double widthMetres, double heightMetres) {
        Scene scene;
        scene.fieldWidthMetres = widthMetres, scene.fieldHeightMetres = heightMetres;
        BodyDescription& ball = scene.bodies.emplace_back();
        ball.positionMetres = {0.7 * widthMetres, 0.7 * heightMetres};
        ball.fixtures = {{.shape = CircleShape{0.1 * heightMetres}}};
        return scene;
    };
    const std::vector<float> loud(8000, 0.5f);
    const float* const channel = loud.data();
    WaveformEnvelope waveform(1, 0, 8000);
    waveform.add(&channel, 8000);
    const Scene first = box(0.14, 0.07);
    for (const Scene& second : {box(0.2, 0.07), box(0.14, 0.1), box(0.14, 0.07)}) {
        PictureInput input;
        input.layout.count = 1, input.layout.places[0] = {0.05, 0.05};
        input.layout.extentWidthMetres = input.layout.extentHeightMetres = 0.07;
        input.waveform = &waveform, input.durationSeconds = 1.0;
        const auto drawn = [&](const Scene& own, const Scene& shown) {
            input.scene = &own;
            input.fieldWidthMetres = own.fieldWidthMetres, input.fieldHeightMetres = own.fieldHeightMetres;
            return RenderMovie{input}.draw(500'000'000, {}, &shown).png();
        };
        EXPECT_TRUE(drawn(first, second) == drawn(second, second))
            << second.fieldWidthMetres << " x " << second.fieldHeightMetres;
    }
}

TEST(RenderMovie, TheLightOfAnImpactEndsWithItsSceneRunAndACompensationHasNone) {
    PictureInput input;
    input.fieldWidthMetres = input.layout.extentWidthMetres = 8.0;
    input.fieldHeightMetres = input.layout.extentHeightMetres = 4.0;
    input.durationSeconds = 1.0;
    std::vector<CollisionEvent> events(1);
    events[0].timeNs = 450'000'000;
    events[0].frequencyHz = 80.0, events[0].decayPerSecond = 34.0, events[0].amplitude = 1.0;
    events[0].x = 4.0, events[0].y = 2.0;
    const auto drawn = [&](std::vector<std::int64_t> runStartsNs) {
        input.runStartsNs = std::move(runStartsNs);
        return RenderMovie{input}.draw(500'000'000, {}).png();
    };
    const auto dark = drawn({});
    input.events = events;
    const auto lit = drawn({0, 450'000'000, 600'000'000});
    EXPECT_TRUE(lit != dark);
    EXPECT_TRUE(drawn({0, 480'000'000}) == dark);
    events.push_back(meanCompensation(events[0]));
    ASSERT_TRUE(isMeanCompensation(events[1]));
    input.events = events;
    EXPECT_TRUE(drawn({}) == lit);
}

TEST_F(MovieCommand, LastsAsLongAsTheRenderAndMoves) {
    const auto made = runs("render drop --seconds 1.5 --movie drop.webp --events drop.csv");
    EXPECT_TRUE(
        has(made.out, "drop.webp  the world, its impacts and every channel in time, 20 pictures per second"));
    const auto movie = animationOf(read("drop.webp"));
    EXPECT_EQ(movie.width, 960u);
    EXPECT_EQ(movie.height, 640u);
    EXPECT_EQ(movie.durationMs, 1500u);
    EXPECT_EQ(movie.frames, 30u); // the time in its corner changes with each
    EXPECT_LT(movie.share, 0.9);  // and the rest stays
    EXPECT_GT(movie.share, 0.05);
    runs("render drop --seconds 1.5 --movie again.webp");
    EXPECT_EQ(read("drop.webp"), read("again.webp"));
    runs("render --from-events drop.csv --field 8,4.5 --seconds 0.2 --movie list.webp");
    EXPECT_EQ(animationOf(read("list.webp")).durationMs, 200u);
}

TEST_F(MovieCommand, RefusesWhatItCannotMake) {
    refuses("render drop --movie drop.avi", 2,
            "--movie: expected a name that ends in .webp, .gif or .mp4, found \"drop.avi\"");
    refuses("render drop --seconds 601 --movie drop.webp", 2, "--movie: expected --seconds of at most 600");
    refuses("render drop --out a.webp --movie a.webp", 2, "a.webp");
}

TEST_F(MovieCommand, WithoutFfmpegItSaysWhatIsMissing) {
    const auto alone = call("render drop --seconds 0.2 --movie drop.mp4 --out drop.wav",
                            "env() { PATH= /usr/bin/env \"$@\"; }; ");
    EXPECT_EQ(alone.exitCode, 1);
    EXPECT_TRUE(has(alone.err, "drop.mp4: .gif and .mp4 need the program ffmpeg"));
    EXPECT_EQ(files().size(), 0u);
}

TEST_F(MovieCommand, HandsPicturesAndWhatIsHeardToFfmpeg) {
    std::filesystem::create_directory(folder_ / "tools");
    write("tools/ffmpeg", "#!/bin/sh\necho \"$@\" >told\nwhile [ $# -gt 1 ]; do [ \"$1\" = -i ] && wc -c "
                          "<\"$2\" >>sizes; shift; done\nprintf movie >\"$1\"\n");
    std::filesystem::permissions(folder_ / "tools/ffmpeg", std::filesystem::perms::owner_all);
    runs("render drop --seconds 0.5 --movie drop.mp4",
         "PATH=\"" + (folder_ / "tools").string() + ":$PATH\"; export PATH; ");
    EXPECT_EQ(read("drop.mp4"), "movie");
    EXPECT_TRUE(has(read("told"), "-c:v png -framerate 20"));
    EXPECT_TRUE(has(read("told"), "-f f32le -ac 1 -ar 48000"));
    EXPECT_TRUE(has(read("sizes"), "\n96000\n")); // 24,000 samples
    EXPECT_EQ(files().size(), 4u); // nothing of what ffmpeg read is left: tools, told, sizes, drop.mp4
}

} // namespace
} // namespace physvib::test
