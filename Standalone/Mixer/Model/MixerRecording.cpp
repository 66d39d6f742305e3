// SPDX-License-Identifier: GPL-3.0-or-later
// Closes a recording after its last block, adds fader moves to the lanes, and finds the user's folder.
#include "Mixer/Model/MixerRecording.h"
#include "Mixer/Model/MixerModel.h"

namespace physvib {

MixerRecording::MixerRecording(Session& session, AudioOutput& output, const Mix& mix,
                               std::function<void()> onChange)
    : session_{session}
    , output_{output}
    , mix_{mix}
    , onChange_{std::move(onChange)} {}

void MixerRecording::complete() {
    if (recording_) close(); // a closed window keeps the recording so far
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
    detachRecorder();
    onChange_();
}

void MixerRecording::detachRecorder() {
    session_.sinks().detach(recording_->recorder());
    isEnding_ = true;
    lastBlock_ = output_.status().blocks + 1;
}

double MixerRecording::seconds() const noexcept {
    return recording_
               ? static_cast<double>(recording_->recorder().frames()) / recording_->recorder().sampleRateHz()
               : 0.0;
}

// The audio thread has released the recorder after one more block; by then the events of the last frames have
// been played too.
void MixerRecording::poll(const AudioOutputStatus& device) {
    if (!recording_) return;
    if (!isEnding_ && recording_->recorder().isRateUnchanged() && recording_->error().empty()) return;
    if (!isEnding_) detachRecorder();
    if (device.isRunning && device.blocks <= lastBlock_) return;
    startFrame_ = recording_->recorder().firstFrame();
    const auto lost = recording_->recorder().framesLost();
    const bool isComplete = recording_->recorder().isRateUnchanged();
    auto error = close();
    if (error.isEmpty() && lost > 0)
        error = "frames missing in the recording: " + juce::String{static_cast<juce::int64>(lost)};
    if (error.isEmpty() && !isComplete) error = "the recording ends where the device changed its rate";
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
    for (PlayedEvent played; session_.played().pop(played);) recording_->addEvent(played);
    SoundNames names;
    names.addScene(*mix_.scene);
    const auto error =
        utf8(recording_->finish(session_.timeline().outputLatencyFrames(), field, provenance, names));
    wasSilent_ = recording_->recorder().peak() == 0.0f;
    recording_.reset();
    return error;
}

namespace {

constexpr double jumpSeconds = 1e-3; // shorter than a step of the world

void setPoint(GainLane& lane, double seconds, double db) {
    if (!lane.empty() && lane.back().seconds >= seconds)
        lane.back().db = db; // the world is paused
    else
        lane.push_back({seconds, db});
}

double maxLaneDb(const GainLane& lane) { return std::ranges::max(lane, {}, &GainPoint::db).db; }

/// Splits the sum of the moved fader and the old lane into a new lane and a fader value. The fader returns to
/// its start value. If it was silent, it gets the highest value of the move instead. If the lane cannot rise
/// that far, the fader is raised by the rest.
void writeLane(const GainLane& moves, double startDb, double& faderDb, GainLane& lane) {
    const double maxMoveDb = maxLaneDb(moves);
    faderDb = startDb <= minStripDb ? maxMoveDb : std::max(startDb, maxMoveDb - maxStripDb);
    GainLane movedLane = moves;
    for (GainPoint& point : movedLane)
        point.db = point.db <= minStripDb ? minStripDb : std::max(minStripDb, point.db - faderDb);
    lane = simplified(sumLanes(lane, movedLane));
}

constexpr const char* folderName = "PhysVib";

/// Whether the folder can be written, or created in the nearest existing folder above it.
bool canBeWritten(juce::File folder) {
    while (!folder.exists() && folder.getParentDirectory() != folder) folder = folder.getParentDirectory();
    return folder.isDirectory() && folder.hasWriteAccess();
}

} // namespace

double MixerLanes::sceneSeconds() const {
    return 1e-9 * static_cast<double>(model_.session().world().sceneNs());
}

std::vector<MixerLanes::Fader> MixerLanes::fadersNow() const {
    const Mix& mix = model_.mix();
    std::vector<Fader> faders;
    for (std::size_t j = 0; j < mix.strips.size(); ++j)
        faders.push_back({mix.strips[j].gainDb, mix.strips[j].gainDb, mix.layout.actuators[j].label});
    for (const StripGroup& group : mix.groups) faders.push_back({group.gainDb, group.gainDb, group.name});
    return faders;
}

void MixerLanes::poll() {
    const bool isRecording = model_.recording().isRunning();
    const auto now = fadersNow();
    const bool haveOthers = stripCount_ != model_.mix().strips.size() || faders_.size() != now.size();
    for (std::size_t i = 0; i < faders_.size() && !haveOthers; ++i) faders_[i].name = now[i].name;
    const bool hasChanged = runNumber_ != model_.session().world().runNumber() || haveOthers;
    if (!faders_.empty() && (!isRecording || hasChanged)) end();
    if (!isRecording) return;
    if (faders_.empty()) {
        stripCount_ = model_.mix().strips.size();
        runNumber_ = model_.session().world().runNumber();
        faders_ = fadersNow();
    } else
        recordMoves(now);
    polledAtSeconds_ = sceneSeconds();
}

// Each move starts at the fader's value of the last poll().
void MixerLanes::recordMoves(const std::vector<Fader>& now) {
    for (std::size_t i = 0; i < now.size(); ++i) {
        Fader& fader = faders_[i];
        const double db = now[i].lastDb;
        if (db == fader.lastDb) continue;
        setPoint(fader.moves, polledAtSeconds_, fader.lastDb);
        setPoint(fader.moves, std::max(polledAtSeconds_ + jumpSeconds, sceneSeconds()), db);
        fader.lastDb = db;
    }
}

// A strip or group is known by its name, as others before it may have gone.
void MixerLanes::end() {
    const auto faders = std::exchange(faders_, {}), now = fadersNow();
    Mix next = model_.mix();
    juce::StringArray names;
    for (std::size_t i = 0; i < faders.size(); ++i) {
        if (faders[i].moves.empty() || maxLaneDb(faders[i].moves) <= minStripDb) continue;
        const bool isStrip = i < stripCount_;
        const auto groups = now.begin() + std::ssize(next.strips), first = isStrip ? now.begin() : groups,
                   last = isStrip ? groups : now.end();
        const auto found =
            std::find_if(first, last, [&](const Fader& f) { return f.name == faders[i].name; });
        if (found == last) continue; // it was removed meanwhile
        const auto write = [&](auto& target) {
            writeLane(faders[i].moves, faders[i].startDb, target.gainDb, target.lane);
        };
        isStrip ? write(nth(next.strips, found - first)) : write(nth(next.groups, found - first));
        names.add(utf8(found->name));
    }
    if (names.isEmpty()) return;
    model_.edit("Record gains", next);
    model_.announce("The moves of " + names.joinIntoString(", ") +
                    " are a lane now (Gain lanes); the faders are back where they were");
}

// The working directory is never used: it is arbitrary if a menu has started the program.
juce::Array<juce::File> UserFolder::candidates() const {
    juce::Array<juce::File> folders;
    if (chosenFolder_ != juce::File{}) folders.add(chosenFolder_);
    for (const auto base : {juce::File::userDocumentsDirectory, juce::File::userHomeDirectory})
        folders.add(juce::File::getSpecialLocation(base).getChildFile(folderName));
    return folders;
}

juce::File UserFolder::location() const {
    for (const auto& folder : candidates())
        if (canBeWritten(folder)) return folder;
    return {};
}

Result<juce::File> UserFolder::create() const {
    for (const auto& folder : candidates())
        if (canBeWritten(folder) && folder.createDirectory().wasOk()) return folder;
    return Failure{pathOf(candidates().getFirst()) + ": expected a folder that can be written"};
}

Result<juce::File> UserFolder::newFile(const juce::String& name, const juce::StringArray& endings) const {
    const auto folder = create();
    if (!folder) return folder;
    for (int k = 1;; ++k) {
        const auto numberedName = name + (k == 1 ? juce::String{} : "-" + juce::String{k});
        bool exists = false;
        for (const auto& ending : endings)
            exists = exists || folder.value.getChildFile(numberedName + ending).exists();
        if (!exists) return folder.value.getChildFile(numberedName + endings[0]);
    }
}

} // namespace physvib
