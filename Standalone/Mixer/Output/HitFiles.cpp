// SPDX-License-Identifier: GPL-3.0-or-later
// Hits by the door of `physvib export`, or as samples.
#include "Mixer/Output/HitFiles.h"
#include "Core/NameNumbers.h"
#include "Live/Recordings/HitExport.h"
#include <algorithm>
#include <filesystem>

namespace physvib {
namespace {

/// The first begins the file; distances stay.
void startAtFirst(std::vector<CollisionEvent>& hits) {
    std::ranges::stable_sort(hits, {}, &CollisionEvent::timeNs);
    const std::int64_t first = hits.front().timeNs;
    for (CollisionEvent& hit : hits) hit.timeNs -= first;
}

/// A new one: of another's of that name, nobody knows what it is.
bool isMadeForUsAlone(const std::filesystem::path& folder) {
    std::error_code fault;
    if (!std::filesystem::create_directory(folder, fault)) return false;
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all, fault);
    return !fault;
}

Result<WrittenHits> writeClip(const HitExport& hits, const PhantomPanner& panner, const std::string& path,
                              ClipFormat format) {
    StrikeClipSettings drawn;
    drawn.channels = static_cast<std::size_t>(panner.channels());
    drawn.gains = [&panner](const CollisionEvent& event, PhantomPanner::Gains& gains) {
        gains = {};
        panner.gainsOf(event, event.spread, gains);
    };
    const auto clip = clipOfHits(hits, drawn);
    if (!clip) return Failure{clip.error};
    const auto parts = partsOf(clip.value, path, format);
    WrittenHits written;
    for (const ClipPart& part : parts) {
        if (parts.size() > 1 && juce::File{part.path}.exists())
            return Failure{part.path + ": is there already; a file for each actuator replaces none"};
        written.paths.push_back(part.path);
    }
    if (const auto done = writeParts(parts, format); !done) return Failure{done.error};
    written.losses = lossesOf(parts, format);
    return written;
}

} // namespace

Result<WrittenHits> writeHits(std::vector<CollisionEvent> hits, const Mix& mix, int sampleRateHz,
                              const juce::File& path) {
    if (hits.empty()) return Failure{"Chosen contacts: expected one whose grains are still kept"};
    if (std::ranges::any_of(hits, [](const CollisionEvent& hit) { return isClip(hit.sound); }))
        return Failure{"Chosen contacts: expected hits, found a clip, which is a file already"};
    startAtFirst(hits);
    const auto panner = mix.panner();
    const auto name = path.getFullPathName().toStdString();
    const HitExport made{"Chosen contacts", path.getFileNameWithoutExtension().toStdString(), hits,
                         mix.layout, mix.layout.name};
    if (const auto format = clipFormatOf(name)) return writeClip(made, panner, name, *format);
    if (!path.hasFileExtension(hitEndings()[0]))
        return Failure{name + ": expected a name that ends in " +
                       hitEndings().joinIntoString(", ").toStdString()};
    const std::string error = writeHitsWav(made, panner, sampleRateHz, name, "physvib " PHYSVIB_VERSION);
    return error.empty() ? Result<WrittenHits>{WrittenHits{{name}, {}}} : Result<WrittenHits>{Failure{error}};
}

Result<juce::File> DraggedFiles::makeFolder() {
    const auto everyones = juce::File::getSpecialLocation(juce::File::tempDirectory);
    if (!folder_.isDirectory()) {
        const auto own = everyones.getChildFile("physvib-mixer-" + juce::Uuid{}.toString());
        if (!isMadeForUsAlone(own.getFullPathName().toStdString()))
            return Failure{everyones.getFullPathName().toStdString() +
                           ": expected a folder to write what is dragged into"};
        folder_ = own;
    }
    const auto folder = folder_.getChildFile(juce::String{++drags_});
    if (const auto made = folder.createDirectory(); made.failed())
        return Failure{folder.getFullPathName().toStdString() + ": " + made.getErrorMessage().toStdString()};
    return folder;
}

} // namespace physvib
