// SPDX-License-Identifier: GPL-3.0-or-later
// Recorded contacts: at a level that is known, in a live session, and in the session that is rendered again
// from its file.
#include "Io/Wav/WavSink.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Live/Recordings/ReadRecording.h"
#include "Live/Recordings/Recording.h"
#include "Live/Session/SessionJournal.h"
#include "Session/FakeHost.h"
#include "Support/FileTesting.h"
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace physvib::session_recordings_test {

using namespace test;

class Recordings : public FolderTest {
protected:
    /// After 50 ms of silence, as much of `samples`.
    std::string write(const std::string& name, const std::vector<float>& sound, float level) const {
        std::vector<float> samples(2400);
        for (const float x : sound) samples.push_back(level * x);
        const float* const at = samples.data();
        WavSink sink{(folder / name).string(), 1, 48000};
        sink.write(&at, static_cast<int>(samples.size()));
        EXPECT_EQ(sink.finish(), "");
        return (folder / name).string();
    }
    std::string writeHit(const std::string& name, std::uint32_t seed, float level) const {
        return write(name, loadContact({300.0, "synthetic-" + std::to_string(seed), 30.0}).value.samples,
                     level);
    }
};

double rms(const std::vector<float>& x, double rate) {
    double sum = 0.0;
    for (std::size_t n = 0; n < std::min(x.size(), static_cast<std::size_t>(matchWindowSeconds * rate)); ++n)
        sum += double{x[n]} * x[n];
    return std::sqrt(sum / (matchWindowSeconds * rate));
}

TEST_F(Recordings, AreAsHighAsTheModeOrAsStrong) {
    const std::string path = writeHit("hit.wav", 3, 0.2f);
    for (const double decay : {12.0, 35.0, 107.0}) {
        const auto high = loadContact({349.0, path, decay, false}),
                   strong = loadContact({349.0, path, decay, true});
        ASSERT_TRUE(high) << high.error;
        float peak = 0.0f;
        for (const float x : high.value.samples) peak = std::max(peak, std::abs(x));
        EXPECT_EQ(peak, 1.0f);
        // of e^(-decay t) sin(2 pi f t): half the envelope's energy, but for what the sine's phase leaves
        const double expected = std::sqrt((1.0 - std::exp(-2.0 * decay * matchWindowSeconds)) /
                                          (4.0 * decay) / matchWindowSeconds);
        EXPECT_NEAR(rms(strong.value.samples, 48000) / expected, 1.0, 0.02) << decay;
    }
}

TEST_F(Recordings, OfAContactWhatLiesBelow5HzIsTakenAwayAndTold) {
    const auto plain = loadContact({349.0, writeHit("hit.wav", 3, 0.2f), 30.0});
    EXPECT_EQ(plain.value.note, "");
    std::vector<float> samples;
    // an accelerometer that the hit has turned
    for (int n = 0; n < 24000; ++n)
        samples.push_back(static_cast<float>(0.3 * std::sin(0.04 * n) * std::exp(-n / 4000.0) - 0.1));
    const std::string path = write("leaning.wav", samples, 1.0f);
    const auto contact = loadContact({300.0, path, 30.0});
    ASSERT_EQ(contact.error, "");
    EXPECT_EQ(contact.value.note.find(path + ": what lies below 5 Hz is not played: a mean of 0."), 0u)
        << contact.value.note;
    double sum = 0.0;
    for (const float x : contact.value.samples) sum += x;
    EXPECT_LT(std::abs(sum / static_cast<double>(contact.value.samples.size())), 0.01);
}

TEST_F(Recordings, WhatIsSyntheticIsTheSameForTheSameSeedOnly) {
    const auto a = loadContact({80.0, "synthetic-1", 34.0}), again = loadContact({80.0, "synthetic-1", 34.0}),
               b = loadContact({80.0, "synthetic-2", 34.0});
    ASSERT_TRUE(a && again && b);
    EXPECT_EQ(a.value.samples, again.value.samples);
    EXPECT_NE(a.value.samples, b.value.samples);
    EXPECT_NE(loadContact({80.0, "synthetic-x", 34.0}).error, "") << "a file's name";
    const auto straight = loadContact({80.0, "synthetic-0", 34.0}).value.samples;
    const double length = 48000.0 * std::log(10.0) / 34.0; // until its mode has a tenth left
    ASSERT_EQ(straight.size(), static_cast<std::size_t>(length));
    for (double n = 0.0; const float x : straight) {
        ASSERT_NEAR(x, (1.0 - n / length) * std::sin(0.01047197551197 * n), 1e-6); // 80 Hz
        ++n;
    }
}

TEST_F(Recordings, NotesOfAllSetsAreToldOnceEach) {
    const ContactRecording a{.note = "a"}, b{.note = "b"};
    EXPECT_EQ(recordingNotes({{{a, {}}, {b, a}, {b}}, {}, {a}}), (std::vector<std::string>{"a", "b"}));
}

TEST_F(Recordings, WhatHasNoneIsRejectedAndWhereThereAreNoneItPlaysItsMode) {
    auto setup = shakeTheBoxSetup(0.02);
    setup.scene.bodies.clear(); // what is struck alone
    setup.scene.joints.clear();
    setup.scene.script.clear();
    const std::vector<ContactRecording> none, other{{300.0, hostRate, std::vector<float>(480, 0.1f)}};
    const CollisionEvent strike{.frequencyHz = 200.0, .decayPerSecond = 50.0, .amplitude = 0.1};
    for (const bool hasOther : {false, true}) {
        setup.recordings = hasOther ? other : none;
        Session session{setup};
        const auto isRejected = [&] {
            const auto before = session.status().render.rejected;
            EXPECT_TRUE(session.submit({Strikes{{&strike, 1}}}));
            Block block;
            for (int i = 0; i < 40; ++i)
                session.advance(), session.render(block.at.data(), 256, RenderMode::realtime);
            EXPECT_EQ(drain(session).size(), session.status().render.rejected == before ? 1u : 0u);
            return session.status().render.rejected > before;
        };
        session.prepare(hostRate, 256);
        EXPECT_EQ(isRejected(), hasOther);
        session.resume(hostRate, 256);
        EXPECT_EQ(isRejected(), hasOther);
        EXPECT_TRUE(session.submit({PlayedRecordings{hasOther ? none : other}}));
        EXPECT_EQ(isRejected(), !hasOther);
    }
}

/// Two seconds of it, with other recordings in the middle and modes at the end.
Interleaved playExchanging(Session& session, const std::vector<ContactRecording>& others,
                           std::int64_t frames) {
    Block block;
    Interleaved signal;
    session.prepare(hostRate, 256);
    for (std::int64_t done = 0; done < frames; done += 250) {
        if (done == frames / 4) {
            EXPECT_TRUE(session.submit({PlayedRecordings{others}}));
        }
        if (done == frames * 3 / 4) {
            EXPECT_TRUE(session.submit({PlayedRecordings{{}}}));
        }
        session.advance();
        session.render(block.at.data(), 250, RenderMode::realtime);
        append(signal, block.at.data(), 250);
        drain(session);
    }
    return signal;
}

TEST_F(Recordings, OfASessionAreKeptByPathAndHashAndRenderedAgainToTheBit) {
    auto setup = shakeTheBoxSetup(0.02);
    const std::string first = writeHit("first.wav", 1, 0.5f), second = writeHit("second.wav", 2, 0.5f);
    const auto load = [&](const std::string& path) {
        std::vector<ContactRecording> all;
        for (const Material& m : setup.scene.materials)
            if (m.frequencyHz > 0.0)
                all.push_back(loadContact({m.frequencyHz, path, m.decayPerSecond, true}).value);
        return all;
    };
    setup.recordings = load(first);
    setup.shaping.gain = 0.5;
    Session session{setup};
    const std::int64_t frames = 8 * hostRate;
    const auto felt = playExchanging(session, load(second), frames);
    const auto file = folder / "monday.json";
    {
        SessionJournal journal{file, session, setup, {}};
        ASSERT_EQ(journal.error(), "");
        journal.end(session.status().sessionNs);
        ASSERT_EQ(journal.finish(), "");
    }
    std::ifstream text{file};
    const std::string json{std::istreambuf_iterator<char>{text}, {}};
    EXPECT_NE(json.find("\"file\": \"first.wav\""), std::string::npos)
        << "beside the session: the folder may move";

    std::filesystem::create_directory(folder / "moved");
    for (const char* name : {"first.wav", "second.wav", "monday.json"})
        std::filesystem::rename(folder / name, folder / "moved" / name);
    const auto saved = loadSession(folder / "moved" / "monday.json");
    ASSERT_TRUE(saved) << saved.error;
    ASSERT_EQ(saved.value.log.recordings.size(), 3u);
    const std::string wav = (folder / "again.wav").string();
    const std::int64_t rendered = frames - session.timeline().outputLatencyFrames();
    ASSERT_EQ(renderSessionWav(
                  saved.value,
                  {hostRate, static_cast<double>(rendered) / hostRate, [](double) { return true; }}, wav, ""),
              "");
    const auto again = readRecording(wav);
    ASSERT_TRUE(again) << again.error;
    float loudest = 0.0f;
    for (std::int64_t n = 0; n < rendered; ++n)
        for (std::size_t j = 0; j < hostChannels; ++j) {
            const float now =
                felt[static_cast<std::size_t>((n + session.timeline().outputLatencyFrames()) * hostChannels) +
                     j];
            loudest = std::max(loudest, std::abs(now));
            ASSERT_EQ(again.value.channels[j][static_cast<std::size_t>(n)], now)
                << "frame " << n << " of channel " << j;
        }
    EXPECT_GT(loudest, 0.01f);

    writeHit("moved/second.wav", 9, 0.5f);
    const auto changed = loadRecordings(saved.value.log);
    EXPECT_NE(changed.error.find("second.wav: expected the recording with the hash "), std::string::npos)
        << changed.error;
    EXPECT_NE(renderSessionWav(saved.value, {hostRate, 1.0, [](double) { return true; }}, wav, "")
                  .find("it has changed since"),
              std::string::npos);
    std::filesystem::remove(folder / "moved" / "second.wav");
    EXPECT_NE(loadRecordings(saved.value.log).error.find("second.wav: cannot be read"), std::string::npos);
}

// The sound of an event leaves a latency after it: so it stands in the list.
TEST_F(Recordings, EventsStandWhereTheirSoundIs) {
    physvib::Recording recording{folder / "take.wav", 1, 48000};
    ASSERT_EQ(recording.error(), "");
    const std::vector<float> silence(4800);
    const float* const channels[] = {silence.data()};
    recording.recorder().onBlock({channels, 4800, 960, 48000}); // begins 20 ms after the session
    recording.addEvent(
        {{.timeNs = 25'000'000, .frequencyHz = 200, .decayPerSecond = 30, .amplitude = 0.5}, 0, false});
    ASSERT_EQ(recording.finish(480, {1.0, 1.0}, {}, {}), "");
    const auto list = loadEventsCsv((folder / "take.csv").string());
    ASSERT_EQ(list.value.events.size(), 1u) << list.error;
    EXPECT_EQ(list.value.events[0].timeNs, 15'000'000);
}

} // namespace physvib::session_recordings_test
