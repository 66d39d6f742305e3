// SPDX-License-Identifier: GPL-3.0-or-later
// Checks one task per word of the design, so the check does not depend on the number of seeds.
#include "CommandLine/Sweep/SweepPlan.h"
#include "Calls/CallFiles.h"
#include "CommandLine/Render/RenderInputs.h"
#include "CommandLine/Sweep/HeardWords.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/ReadFile.h"
#include "Options/Parser.h"
#include "Scene/SceneFileLimits.h"
#include <filesystem>

namespace physvib {
namespace {

std::string hashOfFile(const std::string& path) {
    const auto text = readFile(path, limits::maxEventsFileBytes);
    return text ? contentHash(text.value) : std::string{};
}

const EmbeddedFile* embeddedScene(const std::string& name) {
    for (const EmbeddedFile& file : embeddedScenes())
        if (file.name == name + ".json") return &file;
    return nullptr;
}

} // namespace

Result<RenderJob> renderOptionsOf(const std::string& call) {
    if (auto fault = writtenWordFault(call); !fault.empty()) return Failure{fault};
    OptionTable words{"physvib", {}};
    RenderJob options;
    OptionTable& render = words.addCommand("render", {});
    declareRenderOptions(render, options);
    const ParsedWords parsed = parseText(words, call);
    if (!parsed.help.empty())
        return Failure{"expected words that say what is rendered, found a call for help"};
    if (!parsed.fault.empty()) return Failure{parsed.reason()};
    if (auto fault = linkOfCallFault(words, {}); !fault.empty()) return Failure{fault};
    noteGiven(render, options);
    if (auto fault = renderInputFault(options); !fault.empty()) return Failure{fault};
    return options;
}

Result<SweepPlan> SweepPlan::of(SweepDesign design, const std::string& name) {
    SweepPlan plan;
    plan.design_ = std::move(design);
    if (auto fault = plan.tryWords(name); !fault.empty()) return Failure{fault};
    return plan;
}

std::string SweepPlan::tryWords(const std::string& name) {
    const SweepDesign all = design_;
    if (const auto fault = tryTask(design_.task(0)); !fault.empty())
        return name + ": " + placeOfFault() + ": " + fault;
    const auto tryOne = [&](const std::string& place) {
        const std::string fault = tryTask(design_.task(0));
        return fault.empty() ? fault : name + ": " + place + ": " + fault;
    };
    for (std::size_t i = 0; i < all.scenes.size(); ++i) {
        design_.scenes = {all.scenes[i]};
        if (auto fault = tryOne("scenes[" + std::to_string(i) + "]"); !fault.empty()) return fault;
        for (std::size_t v = 0; v < all.scenes[i].variables.size(); ++v)
            for (const std::string& value : all.scenes[i].variables[v].values) {
                design_.scenes = {all.scenes[i]};
                design_.scenes.front().variables[v].values = {value};
                if (auto fault = tryOne(all.scenes[i].variables[v].place); !fault.empty()) return fault;
            }
    }
    design_.scenes = all.scenes;
    for (std::size_t f = 0; f < all.factors.size(); ++f) {
        for (const std::string& value : all.factors[f].values) {
            design_.factors[f].values = {value};
            if (auto fault = tryOne(all.factors[f].place); !fault.empty()) return fault;
        }
        design_.factors[f] = all.factors[f];
    }
    return {};
}

std::string SweepPlan::placeOfFault() {
    for (std::size_t f = 0; f < design_.factors.size(); ++f) {
        SweepDesign without = design_;
        without.factors.erase(without.factors.begin() + static_cast<std::ptrdiff_t>(f));
        if (tryTask(without.task(0)).empty()) return design_.factors[f].place;
    }
    return "scenes[0]";
}

std::string SweepPlan::tryTask(const SweepTask& task) {
    const auto options = renderOptionsOf(task.call);
    if (!options) return options.error;
    LoadedRender job{options.value, {}, {}, {}, {}};
    const HeardWords heard;
    if (takeInputs(job) != exitDone) return heard.reason();
    channels_ = std::max(channels_, job.channels());
    noteFile(task.scene, task.scene);
    for (const std::string& option : task.options) noteFile(option, option);
    for (const RecordedSound& sound : options.value.sounds) noteFile(sound.path, sound.path);
    for (const std::string& path : job.namedInputs()) noteFile(options.value.layout, path);
    return {};
}

void SweepPlan::noteFile(const std::string& word, const std::string& path) {
    auto& files = files_[word];
    if (files.contains(path)) return;
    std::error_code none;
    if (const EmbeddedFile* scene = embeddedScene(path))
        files[path] = contentHash(scene->text);
    else if (std::filesystem::is_regular_file(path, none))
        files[path] = hashOfFile(path);
}

std::string SweepPlan::filesOf(const SweepTask& task) const {
    std::map<std::string, std::string> all;
    const auto add = [&](const std::string& word) {
        if (const auto found = files_.find(word); found != files_.end())
            all.insert(found->second.begin(), found->second.end());
    };
    add(task.scene);
    for (const std::string& option : task.options) add(option);
    for (const std::string& sound : design_.sounds)
        if (task.call.find(sound) != std::string::npos) add(sound.substr(sound.find('=') + 1));
    std::string words;
    for (const auto& [path, hash] : all) words += (words.empty() ? "" : " ") + path + '=' + hash;
    return words;
}

PlannedTask SweepPlan::at(std::uint64_t index) const {
    PlannedTask planned{design_.task(index), {}, {}};
    planned.files = filesOf(planned.task);
    planned.hash = contentHash("physvib " PHYSVIB_VERSION " sweep " + std::to_string(sweepResultVersion) +
                               '\n' + planned.task.call + '\n' + planned.files);
    return planned;
}

bool SweepPlan::isUnchanged(const PlannedTask& planned) const {
    for (const auto& [word, files] : files_)
        for (const auto& [path, hash] : files)
            if (planned.files.find(path + '=') != std::string::npos && !embeddedScene(path) &&
                hashOfFile(path) != hash)
                return false;
    return true;
}

} // namespace physvib
