// SPDX-License-Identifier: GPL-3.0-or-later
// Closes a recording after its last block, and adds moves of faders to the lanes that played.
#include "Mixer/Model/MixerRecording.h"
#include "Mixer/Model/MixerModel.h"

namespace physvib {

MixerRecording::MixerRecording(Session& session, AudioOutput& output, const Mix& mix,
                               std::function<void()> onChange)
    : session_{session}
    , output_{output}
    , mix_{mix}
    , onChange_{std::move(onChange)} {}

void MixerRecording::keep() {
    if (recording_) close(); // closing the window keeps the recording so far
}

std::string MixerRecording::start(const juce::File& file) {
    if (recording_) return {};
    if (output_.sampleRateHz() == 0) return "nothing to record: no device runs";
    auto recording = std::make_unique<Recording>(pathOf(file), mix_.count(), output_.sampleRateHz());
    if (!recording->error().empty()) return recording->error();
    recording_ = std::move(recording);
    file_ = file;
    isEnding_ = false;
    session_.sinks().attach(recording_->recorder());
    onChange_();
    return {};
}

void MixerRecording::stop() {
    if (!isRunning()) return;
    letGo();
    onChange_();
}

void MixerRecording::letGo() {
    session_.sinks().detach(recording_->recorder());
    isEnding_ = true;
    endsAfterBlock_ = output_.status().blocks + 1;
}

double MixerRecording::seconds() const noexcept {
    return recording_
               ? static_cast<double>(recording_->recorder().frames()) / recording_->recorder().sampleRateHz()
               : 0.0;
}

// The audio thread has released the recorder after one more block; by then the events of the last frames have
// been played too.
void MixerRecording::look(const AudioOutputStatus& device) {
    if (!recording_) return;
    if (!isEnding_ && recording_->recorder().isWhole() && recording_->error().empty()) return;
    if (!isEnding_) letGo();
    if (device.isRunning && device.blocks <= endsAfterBlock_) return;
    from_ = recording_->recorder().firstFrame();
    const auto lost = recording_->recorder().framesLost();
    const bool isWhole = recording_->recorder().isWhole();
    auto error = close();
    if (error.isEmpty() && lost > 0)
        error = "frames missing in the recording: " + juce::String{static_cast<juce::int64>(lost)};
    if (error.isEmpty() && !isWhole) error = "the recording ends where the device changed its rate";
    if (onEnd) onEnd(file_, error);
    onChange_();
}

// Precondition: the audio thread released the recorder or does not run. Moves both files to their places;
// returns an empty string or one error line.
juce::String MixerRecording::close() {
    const Provenance provenance{PHYSVIB_VERSION,
                                {{"scene", mix_.scene->name}, {"seed", std::to_string(mix_.seed)}}};
    const FieldSize field{mix_.scene->fieldWidthMetres, mix_.scene->fieldHeightMetres};
    session_.sinks().detach(recording_->recorder());
    for (PlayedEvent played; session_.played().pop(played);) recording_->take(played);
    SoundNames names;
    names.addScene(*mix_.scene);
    const auto error =
        utf8(recording_->finish(session_.timeline().outputLatencyFrames(), field, provenance, names));
    wasSilent_ = recording_->recorder().peak() == 0.0f;
    recording_.reset();
    return error;
}

namespace {

constexpr double jumpSeconds = 1e-3; // between two steps of the world

void setPoint(GainLane& lane, double seconds, double db) {
    if (!lane.empty() && lane.back().seconds >= seconds)
        lane.back().db = db; // the world is paused
    else
        lane.push_back({seconds, db});
}

double highestDb(const GainLane& lane) { return std::ranges::max(lane, {}, &GainPoint::db).db; }

/// Splits the sum of the moved fader and the old lane into a new lane and a fader value. The fader returns to
/// its start value. If it was silent, it gets the highest value of the move instead. If the lane cannot rise
/// that far, the fader is raised by the rest.
void write(const GainLane& moves, double startDb, double& faderDb, GainLane& lane) {
    const double highest = highestDb(moves);
    faderDb = startDb <= leastStripDb ? highest : std::max(startDb, highest - mostStripDb);
    GainLane moved = moves;
    for (GainPoint& point : moved)
        point.db = point.db <= leastStripDb ? leastStripDb : std::max(leastStripDb, point.db - faderDb);
    lane = thinned(sumOf(lane, moved));
}

constexpr const char* folderName = "PhysVib";

/// Whether it can be written, or created in the nearest folder above it that exists.
bool canBeWritten(juce::File folder) {
    while (!folder.exists() && folder.getParentDirectory() != folder) folder = folder.getParentDirectory();
    return folder.isDirectory() && folder.hasWriteAccess();
}

} // namespace

double MixerLanes::sceneSeconds() const {
    return 1e-9 * static_cast<double>(model_.session().world().sceneNs());
}

std::vector<double> MixerLanes::faders() const {
    std::vector<double> all;
    for (const Strip& strip : model_.mix().strips) all.push_back(strip.gainDb);
    for (const StripGroup& group : model_.mix().groups) all.push_back(group.gainDb);
    return all;
}

void MixerLanes::look() {
    const bool isWanted = model_.recording().isRunning();
    const bool isOther = run_ != model_.session().world().take() || strips_ != model_.mix().strips.size() ||
                         faders_.size() != strips_ + model_.mix().groups.size();
    if (!faders_.empty() && (!isWanted || isOther)) end();
    if (!isWanted) return;
    if (faders_.empty()) {
        strips_ = model_.mix().strips.size();
        run_ = model_.session().world().take();
        for (const double db : faders()) faders_.push_back({db, db});
    } else
        follow();
    lookedAtSeconds_ = sceneSeconds();
}

// Each move starts at the fader's value of the last look().
void MixerLanes::follow() {
    const auto now = faders();
    for (std::size_t i = 0; i < now.size(); ++i) {
        Fader& fader = faders_[i];
        if (now[i] == fader.nowDb) continue;
        setPoint(fader.moves, lookedAtSeconds_, fader.nowDb);
        setPoint(fader.moves, std::max(lookedAtSeconds_ + jumpSeconds, sceneSeconds()), now[i]);
        fader.nowDb = now[i];
    }
}

void MixerLanes::end() {
    const auto moved = std::exchange(faders_, {});
    Mix next = model_.mix();
    juce::StringArray names;
    for (std::size_t i = 0; i < moved.size(); ++i) {
        if (moved[i].moves.empty() || highestDb(moved[i].moves) <= leastStripDb) continue;
        const std::size_t k = i - std::min(i, strips_);
        if (i < strips_ ? i >= next.strips.size() : k >= next.groups.size())
            continue; // it was removed meanwhile
        if (i < strips_) {
            write(moved[i].moves, moved[i].startDb, next.strips[i].gainDb, next.strips[i].lane);
            names.add(labelOf(next, i));
        } else {
            write(moved[i].moves, moved[i].startDb, next.groups[k].gainDb, next.groups[k].lane);
            names.add(utf8(next.groups[k].name));
        }
    }
    if (names.isEmpty()) return;
    model_.edit("Record gains", next);
    model_.announce("The moves of " + names.joinIntoString(", ") +
                    " are a lane now (Gain lanes); the faders are back where they were");
}

// Never the working directory, which may be anything when a program is started from a menu.
juce::Array<juce::File> UserFolder::candidates() const {
    juce::Array<juce::File> all;
    if (chosen_ != juce::File{}) all.add(chosen_);
    for (const auto where : {juce::File::userDocumentsDirectory, juce::File::userHomeDirectory})
        all.add(juce::File::getSpecialLocation(where).getChildFile(folderName));
    return all;
}

juce::File UserFolder::place() const {
    for (const auto& folder : candidates())
        if (canBeWritten(folder)) return folder;
    return {};
}

Result<juce::File> UserFolder::make() const {
    for (const auto& folder : candidates())
        if (canBeWritten(folder) && folder.createDirectory().wasOk()) return folder;
    return Failure{pathOf(candidates().getFirst()) + ": expected a folder that can be written"};
}

Result<juce::File> UserFolder::fresh(const juce::String& name, const juce::StringArray& endings) const {
    const auto folder = make();
    if (!folder) return folder;
    for (int k = 1;; ++k) {
        const auto numbered = name + (k == 1 ? juce::String{} : "-" + juce::String{k});
        bool isTaken = false;
        for (const auto& ending : endings)
            isTaken = isTaken || folder.value.getChildFile(numbered + ending).exists();
        if (!isTaken) return folder.value.getChildFile(numbered + endings[0]);
    }
}

} // namespace physvib
