// SPDX-License-Identifier: MIT
// Lowers each value of a mixer state to its limit, and notes what was lowered.
#include "Live/Documents/DeskLimits.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/MixJson.h"
#include "Live/Documents/StripGroups.h"
#include <algorithm>

namespace physvib {
namespace {

constexpr std::size_t mostTextBytes = 100'000; // 64 strips need 8 kB

class Notes {
public:
    void lower(double& value, double most, const std::string& what) {
        if (value <= most) return;
        add(what + ' ' + fixedNumber(value, 1) + " to " + fixedNumber(most, 1) + " dB");
        value = most;
    }
    void add(const std::string& note) {
        constexpr int mostNotes = 8; // users do not read more
        if (++count_ <= mostNotes) words_ += (words_.empty() ? "" : "; ") + note;
    }
    std::string words() const { return words_; }

private:
    std::string words_;
    int count_ = 0;
};

/// The highest fader position at which the strip's loudest gain, with group and lanes, is `mostDb`.
double mostFaderDb(const Mix& mix, std::size_t strip, double mostDb) {
    if (loudestDb(mix, strip) <= mostDb) return mostStripDb;
    return mostDb <= leastStripDb ? leastStripDb
                                  : std::clamp(mostDb - mostAddedDb(mix, strip), leastStripDb, mostStripDb);
}

void lowerStrip(const Strip* most, bool isSilentThere, double mostDb, Strip& strip, const std::string& label,
                Notes& notes) {
    if (most == nullptr) {
        notes.add(label + " without output " + std::to_string(strip.output + 1));
        strip.output = -1;
        return;
    }
    notes.lower(strip.gainDb, mostDb, label + " gain");
    notes.lower(strip.ceilingDb, most->ceilingDb, label + " ceiling");
    if (!isSilentThere || strip.isMuted) return;
    notes.add(label + " muted");
    strip.isMuted = true;
}

} // namespace

DeskLimits DeskLimits::of(const Mix& mix) {
    std::vector<Strip> strips = feltStrips(mix);
    for (std::size_t j = 0; j < strips.size(); ++j) strips[j].gainDb = loudestDb(mix, j);
    return {mix.levelDb, strips};
}

double DeskLimits::loudestOutputDb() const {
    std::vector<double> gains;
    for (const Strip& strip : strips)
        if (strip.output >= 0) gains.push_back(std::min(strip.gainDb, strip.ceilingDb));
    return gains.empty() ? levelDb : std::max(leastStripDb, levelDb + std::ranges::max(gains));
}

std::string lowerTo(const DeskLimits& most, Mix& mix) {
    Notes notes;
    notes.lower(mix.levelDb, most.levelDb, "master");
    for (std::size_t j = 0; j < mix.strips.size(); ++j) {
        Strip& strip = mix.strips[j];
        if (strip.output < 0) continue;
        const auto own = std::ranges::find(most.strips, strip.output, &Strip::output);
        const bool isThere = own != most.strips.end();
        lowerStrip(isThere ? &*own : nullptr,
                   isThere && isSilent(most.strips, static_cast<std::size_t>(own - most.strips.begin())),
                   isThere ? mostFaderDb(mix, j, own->gainDb) : leastStripDb, strip,
                   mix.layout.enchanters[j].label, notes);
    }
    return notes.words();
}

std::string deskLimitsText(const DeskLimits& limits) { return writeTable(limits).dump(); }

std::optional<DeskLimits> readDeskLimits(std::string_view text) {
    auto read = readJson(text, "settings", mostTextBytes, [](const Json& root) {
        return kinds::Object<DeskLimits>{}(JsonField{root, {}});
    });
    return read ? std::optional{std::move(read.value)} : std::nullopt;
}

} // namespace physvib
