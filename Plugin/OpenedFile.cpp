// SPDX-License-Identifier: GPL-3.0-or-later
// By what the file says it is.
#include "OpenedFile.h"
#include "Files/Disk/FileKind.h"
#include "Files/SceneFile.h"
#include "Files/SessionFile.h"
#include "Parameters.h"
#include "PluginSettings.h"
#include <algorithm>

namespace physvib {

namespace {

void setParameter(PluginState& state, Parameter which, double value) {
    const auto& row = rowOf(which);
    const auto found = std::ranges::find_if(state.parameters, [&row](const auto& p) { return p.first == row.id; });
    auto& kept = found == state.parameters.end() ? state.parameters.emplace_back(std::string{row.id}, 0.0) : *found;
    kept.second = std::clamp(value, row.least, row.most);
}

PluginState leftBy(const SavedSession& session, PluginState state) {
    const Mix mix = mixOf(session);
    takeScene(state, *mix.scene);
    state.seed = mix.seed;
    state.stepsPerSecond = session.run.stepsPerSecond;
    state.layout = mix.layout;
    state.strips = mix.strips;
    for (std::size_t j = 0; j < state.strips.size(); ++j) state.strips[j].output = static_cast<int>(j);
    state.equalised = session.equalised;
    state.limiterEnabled = session.limiterEnabled;
    setParameter(state, Parameter::law, static_cast<double>(mix.law));
    setParameter(state, Parameter::exponent, mix.exponent);
    setParameter(state, Parameter::level, mix.levelDb);
    return state;
}

bool isPlayedOtherwise(const SavedSession& session) {
    return session.shaping != EventShaping{} || !session.log.recordings.empty() || !session.log.clips.empty() || session.run.timing != ImpactTiming::onset || session.run.location != ImpactLocation::contact;
}

} // namespace

Result<OpenedFile> openFile(const std::filesystem::path& path, PluginState state) {
    switch (fileKind(path)) {
    case FileKind::scene: {
        auto scene = loadScene(path);
        if (!scene) return Failure{scene.error};
        takeScene(state, std::move(scene.value));
        return OpenedFile{std::move(state), {}};
    }
    case FileKind::layout: {
        auto layout = loadLayout(path);
        if (!layout) return Failure{layout.error};
        state.layout = std::move(layout.value);
        fitToLayout(state);
        return OpenedFile{std::move(state), {}};
    }
    case FileKind::session: {
        const auto session = loadSession(path);
        if (!session) return Failure{session.error};
        const std::string note = isPlayedOtherwise(session.value) ? path.filename().string() + ": its method, timing and recordings are not played here" : std::string{};
        return OpenedFile{leftBy(session.value, std::move(state)), note};
    }
    case FileKind::unknown: break;
    }
    return Failure{path.string() + ": expected a scene, a layout or a saved session"};
}

} // namespace physvib
