// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a dropped clip to a message, and reports its result on the message thread.
#include "Mixer/Desk/DeskClips.h"
#include "Live/Recordings/ClipFolder.h"
#include <utility>

namespace physvib {

bool isClipDrag(const juce::StringArray& files) {
    return !files.isEmpty() && !files[0].endsWithIgnoreCase(".json");
}

DeskClips::DeskClips(Session& session, const AudioOutput& output,
                     std::function<void(const Result<std::string>&)> told)
    : output_{output}
    , told_{std::move(told)}
    , messages_{session} {}

DeskClips::~DeskClips() {
    constexpr int untilItHasBeenRead = -1;
    reader_.removeAllJobs(false, untilItHasBeenRead); // after this no thread triggers an update
    cancelPendingUpdate();
}

void DeskClips::feel(const juce::File& file, const EnchanterPlace& atMetres, bool isAlone) {
    PlainMessage clip{"clip",
                      {{"file", file.getFullPathName().toStdString()},
                       {"place", std::vector{atMetres.xMetres, atMetres.yMetres}}}};
    if (isAlone) clip.values.push_back({"law", std::string{nameOf(Spread::alone)}});
    read(std::move(clip));
}

void DeskClips::play(const juce::File& file) {
    read({"clip", {{"file", file.getFullPathName().toStdString()}}});
}

void DeskClips::read(PlainMessage clip) {
    reader_.addJob([this, clip = std::move(clip)] {
        auto result = strike(clip);
        const std::lock_guard lock{mutex_};
        results_.push_back(std::move(result));
        triggerAsyncUpdate();
    });
}

// Runs on the reader's thread.
Result<std::string> DeskClips::strike(const PlainMessage& clip) {
    const auto unlessLent = [this](const std::string& path) { // a study may have borrowed the output while
                                                              // earlier clips were read
        return output_.isLent() ? Result<LoadedClip>{Failure{"a study is running"}} : loadWholeClip(path);
    };
    const auto result = messages_.take(clip, nullptr, unlessLent);
    if (!result) return Failure{result.error};
    // a note, if there is one
    return result.value.values.empty() ? std::string{}
                                       : std::get<std::string>(result.value.values.front().value);
}

void DeskClips::handleAsyncUpdate() {
    std::vector<Result<std::string>> results;
    {
        const std::lock_guard lock{mutex_};
        results.swap(results_);
    }
    for (const auto& result : results) told_(result);
}

} // namespace physvib
