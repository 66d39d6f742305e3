// SPDX-License-Identifier: GPL-3.0-or-later
// Mutated files of every kind through the program: physvib-hostile PROGRAM COUNT [SEED [SECONDS]]. Each call
// leaves with 0, or with 1 or 2 after one clean line, takes at most 300 MB and SECONDS of processor, and
// leaves nothing half-done. Ends with a table; the inputs of failures stay.
#include "Io/Text/CleanText.h"
#include "Support/Mutations.h"
#include "Support/WavBytes.h"
#include "Support/WriteSound.h"
#include "TestPlaces.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace physvib {
namespace {

namespace fs = std::filesystem;

constexpr long mostKilobytes = 300'000;

struct Kind {
    std::string name;                  ///< of its corpus, too
    std::string ending;                ///< of its files
    std::vector<std::string> calls;    ///< FILE is the mutated one
    std::vector<std::string> wholes{}; ///< files that are read
};

struct Outcome {
    int exitCode = -1; ///< 128 + the signal that ended it
    double seconds = 0.0;
    long kilobytes = 0;
    std::string err;
};

std::string bytesOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>{file}, {}};
}

std::vector<std::string> filesIn(const fs::path& folder) {
    std::vector<fs::path> paths(fs::directory_iterator{folder}, {});
    std::ranges::sort(paths);
    std::vector<std::string> texts;
    for (const fs::path& path : paths)
        if (fs::is_regular_file(path)) texts.push_back(bytesOf(path));
    return texts;
}

/// A knock of half a second as these bytes, one channel.
std::string knock(int format, const fs::path& folder) {
    std::vector<float> samples;
    for (int n = 0; n < 22050; ++n)
        samples.push_back(
            n < 2000 ? 0.0f : static_cast<float>(0.8 * std::sin(0.03 * n) * std::exp(-0.001 * (n - 2000))));
    const auto path = folder / "knock";
    if (!test::writeSound(path, format, {48000, {samples}}))
        throw std::runtime_error("no writer for the format " + std::to_string(format));
    const std::string bytes = bytesOf(path);
    fs::remove(path);
    return bytes;
}

std::vector<Kind> kindsOf(const fs::path& source, const fs::path& folder) {
    const fs::path corpus = source / "Tests/Fuzz/corpus";
    const std::vector<std::string> recordingCalls{"material FILE", "material --texture FILE --speed 0.3",
                                                  "attenuation FILE FILE",
                                                  "stimulus wav FILE --at 0.3,0.4 --level-g 0.5 --out o.wav",
                                                  "render drop --seconds 0.5 --method SV --sound 80=FILE "
                                                  "--sound 349=FILE --sound 430=FILE --out o.wav"};
    const std::vector<std::string> clipCalls{"render FILE --out o.wav --picture p.png",
                                             "render FILE --layout ring3 --out o.wav",
                                             "export FILE --to o.hjif",
                                             "export FILE --to o.haptic",
                                             "export FILE --to o.ahap",
                                             "stimulus wav FILE --at 0.3,0.4 --level-g 0.5 --out o.wav"};
    const std::string table = " FILE --export e.csv --picture p.svg";
    std::vector<Kind> kinds{
        {"scene",
         "json",
         {"render FILE --seconds 0.1 --out o.wav --events e.csv",
          "render FILE --seconds 0.1 --picture p.png"}},
        {"session",
         "json",
         {"render FILE --seconds 0.1 --out o.wav",
          "render FILE --seconds 0.1 --layout ring2 --events e.csv"}},
        {"events", "csv", {"render --from-events FILE --seconds 0.1 --out o.wav --picture p.png"}},
        {"layout",
         "json",
         {"render shake-the-box --seconds 0.1 --layout FILE --out o.wav --picture p.png",
          "stimulus phantom --at 0.2,0.3 --layout FILE --out o.wav"}},
        {"actuator",
         "json",
         {"render shake-the-box --seconds 0.1 --actuator FILE --out o.wav",
          "render shake-the-box --seconds 0.1 --actuator FILE --remap on --out o.wav"}},
        {"coupling",
         "json",
         {"render shake-the-box --seconds 0.1 --layout phone2 --coupling FILE --out o.wav"}},
        {"protocol",
         "json",
         {"study show FILE", "study run FILE --observer simulated --participant P --out ."}},
        {"study",
         "csv",
         {"analyse confusion" + table, "analyse resolution" + table, "analyse percent-counts" + table,
          "analyse choices" + table, "analyse ratings" + table, "analyse levels" + table,
          "analyse psychometric FILE --level x --measure y --export e.csv"}}};
    for (const char* clip : {"hjif", "haptic", "ahap"}) kinds.push_back({clip, clip, clipCalls});
    for (Kind& kind : kinds) kind.wholes = filesIn(corpus / kind.name);
    for (auto& scene : filesIn(source / "Source/Scene/Scenes"))
        kinds.front().wholes.push_back(std::move(scene));
    for (const auto& [name, format] : {std::pair{"wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16},
                                       {"aiff", SF_FORMAT_AIFF | SF_FORMAT_PCM_16},
                                       {"flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_16},
                                       {"ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS},
                                       {"opus", SF_FORMAT_OGG | SF_FORMAT_OPUS}})
        kinds.push_back({name, name, recordingCalls, {knock(format, folder)}});
    return kinds;
}

Outcome run(const std::string& program, const fs::path& folder, const std::string& words) {
    std::vector<std::string> parts{program};
    std::istringstream rest{words};
    for (std::string word; rest >> word;) parts.push_back(word);
    std::vector<char*> arguments;
    for (std::string& part : parts) arguments.push_back(part.data());
    arguments.push_back(nullptr);
    const std::string err = (folder / ".err").string();
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        const rlimit processor{30, 30}; // what spins ends
        setrlimit(RLIMIT_CPU, &processor);
        unsetenv("DISPLAY");
        const bool isReady = chdir(folder.c_str()) == 0 && std::freopen("/dev/null", "r", stdin) &&
                             std::freopen("/dev/null", "w", stdout) && std::freopen(err.c_str(), "w", stderr);
        if (isReady) execv(arguments[0], arguments.data());
        _exit(127);
    }
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            seconds(used.ru_utime) + seconds(used.ru_stime), used.ru_maxrss, bytesOf(err)};
}

/// Empty, or what is wrong with how the program left.
std::string faultOf(const Outcome& outcome, const fs::path& folder, double mostSeconds) {
    std::istringstream lines{outcome.err};
    int reasons = 0;
    for (std::string line; std::getline(lines, line);) {
        // libFLAC 1.5 says so by itself
        if (line.starts_with("Rewinding, seeking ") || line.starts_with("Bitreader was ")) continue;
        if (cleanLine(line) != line || !line.starts_with("physvib: "))
            return "not a clean line: " + cleanLine(line);
        reasons += !line.starts_with("physvib: warning: ");
    }
    if (outcome.exitCode < 0 || outcome.exitCode > 2) return "ended by " + std::to_string(outcome.exitCode);
    if (outcome.exitCode > 0 && reasons != 1) return std::to_string(reasons) + " reasons for leaving";
    if (outcome.kilobytes > mostKilobytes) return "took " + std::to_string(outcome.kilobytes / 1000) + " MB";
    if (outcome.seconds > mostSeconds) return "took " + std::to_string(outcome.seconds) + " s";
    for (const auto& entry : fs::directory_iterator{folder})
        if (entry.path().extension().string().starts_with(".part") ||
            (outcome.exitCode > 0 && entry.path().stem() == "o"))
            return "left " + entry.path().filename().string();
    return {};
}

struct Tally {
    int calls = 0, done = 0, refused = 0;
    long kilobytes = 0;
    double seconds = 0.0;
};

int runAll(const std::string& program, int count, unsigned seed, double mostSeconds) {
    std::mt19937 random{seed};
    const fs::path base = fs::temp_directory_path() / ("physvib-hostile-" + std::to_string(getpid()));
    fs::create_directories(base);
    const auto kinds = kindsOf(PHYSVIB_SOURCE_DIR, base);
    std::map<std::string, Tally> tallies;
    int failures = 0;
    for (int i = 0; i < count; ++i) {
        const Kind& kind = kinds[static_cast<std::size_t>(i) % kinds.size()];
        std::string bytes = kind.wholes[anyIndex(random, kind.wholes.size())];
        const bool isExtreme = random() % 2 == 0; // one accident, so that some still are what they were
        if (isExtreme) bytes = withExtreme(std::move(bytes), random);
        if (!isExtreme || random() % 4 == 0)
            bytes = mutated(std::move(bytes), "{}[]\",:.-+eE0123456789\n\xff\x80\x1b", random);
        const fs::path folder = base / "run";
        fs::remove_all(folder);
        fs::create_directories(folder);
        const std::string name = "f." + kind.ending;
        std::ofstream{folder / name, std::ios::binary} << bytes;
        std::string words = kind.calls[anyIndex(random, kind.calls.size())];
        for (std::size_t at = words.find("FILE"); at != std::string::npos; at = words.find("FILE"))
            words.replace(at, 4, name);
        const Outcome outcome = run(program, folder, words);
        Tally& tally = tallies[kind.name];
        ++tally.calls;
        ++(outcome.exitCode == 0 ? tally.done : tally.refused);
        tally.kilobytes = std::max(tally.kilobytes, outcome.kilobytes);
        tally.seconds = std::max(tally.seconds, outcome.seconds);
        if (const std::string fault = faultOf(outcome, folder, mostSeconds); !fault.empty()) {
            const fs::path kept = base / ("failure-" + std::to_string(++failures) + "." + kind.ending);
            std::ofstream{kept, std::ios::binary} << bytes;
            std::printf("FAILED: physvib %s: %s (input: %s)\n", words.c_str(), fault.c_str(), kept.c_str());
        }
    }
    fs::remove_all(base / "run");
    if (failures == 0) fs::remove_all(base);
    std::printf("kind       calls  done  refused  most MB  most s of processor\n");
    for (const auto& [name, t] : tallies)
        std::printf("%-9s %6d %5d %8d %8.0f %8.2f\n", name.c_str(), t.calls, t.done, t.refused,
                    static_cast<double>(t.kilobytes) * 1e-3, t.seconds);
    std::printf("%d calls, %d failed (seed %u)\n", count, failures, seed);
    return failures == 0 ? 0 : 1;
}

} // namespace
} // namespace physvib

int main(int argc, char** argv) {
    if (argc < 3) return std::fputs("physvib-hostile PROGRAM COUNT [SEED [SECONDS]]\n", stderr), 2;
    return physvib::runAll(std::filesystem::absolute(argv[1]).string(), std::stoi(argv[2]),
                           argc > 3 ? static_cast<unsigned>(std::stoul(argv[3])) : 1u,
                           argc > 4 ? std::stod(argv[4]) : HUGE_VAL);
}
