// SPDX-License-Identifier: GPL-3.0-or-later
// The queue of messages, texts about impacts, and hints on materials, bodies and levels without vibration.
#include "Mixer/Model/MixerMessages.h"
#include "Core/NameNumbers.h"
#include "Mixer/Model/MixerModel.h"
#include "Scene/Drawing/ImpactTrial.h"
#include <ranges>

namespace physvib {
namespace {

bool hasLabel(const MixerMessage& message, const juce::String& label) {
    return label.isNotEmpty() && message.label == label;
}

constexpr const char *hintLabel = "felt", *fixName = "Make it felt";

void showHint(MixerModel& model, const std::string& name, const std::string& reason,
              std::function<void()> fix) {
    if (reason.empty()) return model.messages().withdraw(hintLabel);
    MixerMessage message{utf8(name) + " is not felt at usual impacts: " + utf8(reason), true, {}, hintLabel};
    if (fix) message.action = {fixName, std::move(fix)};
    model.messages().show(std::move(message));
}

/// Gives the material a sound, as an edit that restarts the scene.
void addSound(MixerModel& model, int material) {
    model.change(fixName, [&](Mix& mix) {
        mix.scene = std::make_shared<const Scene>(sceneWithSound(model.world().drawing().drawn(), material));
    });
}

} // namespace

void MixerMessages::display(MixerMessage message) {
    const bool isSame = message.text == current_.text && message.isInfo == current_.isInfo &&
                        message.action.name == current_.action.name;
    current_ = std::move(message);
    ++shownCount_;
    if (!isSame) onChange_();
}

void MixerMessages::show(MixerMessage message) {
    const bool isEmpty = message.text.isEmpty();
    std::erase_if(queue_, [&](const MixerMessage& m) { return hasLabel(m, message.label); });
    if (isEmpty && !queue_.empty()) {
        message = std::move(queue_.front());
        queue_.pop_front();
    } else if (!isEmpty && current_.isPersistent() && current_.text != message.text &&
               !hasLabel(current_, message.label))
        queue_.push_front(current_); // its cause still exists
    display(std::move(message));
}

void MixerMessages::add(MixerMessage message) {
    if (current_.text.isEmpty() || hasLabel(current_, message.label)) return display(std::move(message));
    const auto same =
        std::ranges::find_if(queue_, [&](const MixerMessage& m) { return hasLabel(m, message.label); });
    if (same != queue_.end())
        *same = std::move(message);
    else
        queue_.push_back(std::move(message));
}

void MixerMessages::withdraw(const juce::String& label) {
    std::erase_if(queue_, [&](const MixerMessage& m) { return hasLabel(m, label); });
    if (hasLabel(current_, label)) show({});
}

int findMaterialIndex(const Scene& scene, const CollisionEvent& hit) {
    const auto hasSound = [&hit](const Material& m) { return hit.sound == soundOfMaterial(m.name); };
    const auto found = std::ranges::find_if(scene.materials, hasSound);
    return found == scene.materials.end() ? -1 : static_cast<int>(found - scene.materials.begin());
}

juce::String materialName(const Scene& scene, const CollisionEvent& hit) {
    const int index = findMaterialIndex(scene, hit);
    return isClip(hit.sound) ? juce::String{"clip"}
           : index < 0       ? juce::String{"hit"}
                             : utf8(nth(scene.materials, index).name);
}

StrongestActuator strongestActuatorFor(const MixerModel& model, const CollisionEvent& hit) {
    const Mix& mix = model.mix();
    PhantomPanner::Gains gains{};
    mix.panner().gainsAt(hit, gains);
    StrongestActuator strongest;
    for (int j = 0; j < mix.count(); ++j) {
        const auto i = static_cast<std::size_t>(j);
        const double levelG =
            std::abs(hit.amplitude) * gains[i] * mix.layout.actuators[i].fullScaleG * masterGain(mix);
        if (levelG > strongest.levelG && model.device().isPlayed(i) && !mix.isSilent(j))
            strongest = {j, levelG};
    }
    return strongest;
}

juce::String reasonNotPlayed(const MixerModel& model, const CollisionEvent& hit) {
    if (model.isVisualOnly()) return "no device";
    PhantomPanner::Gains gains{};
    model.mix().panner().gainsAt(hit, gains);
    const auto nearest = std::ranges::max_element(gains) - gains.begin();
    const auto j = static_cast<std::size_t>(nearest);
    const auto label = labelOf(model.mix(), j);
    if (!model.device().isPlayed(j)) return label + " has no output";
    if (model.mix().strips[j].isMuted) return label + " is muted";
    return model.mix().isSilent(static_cast<int>(j)) ? label + " is not soloed" : juce::String{"too weak"};
}

juce::String placeText(const Scene& scene, const CollisionEvent& hit) {
    const double x = hit.x / scene.fieldWidthMetres, y = hit.y / scene.fieldHeightMetres;
    const juce::String column = x < 0.15   ? "left"
                                : x > 0.85 ? "right"
                                           : "",
                       row = y < 0.15   ? "bottom"
                             : y > 0.85 ? "top"
                                        : "";
    return column.isEmpty() && row.isEmpty() ? juce::String{"in the middle"}
                                             : "at the " + (row + " " + column).trim();
}

void hintOnMaterial(MixerModel& model, int material) {
    const Scene& scene = model.world().drawing().drawn();
    if (material < 0 || material >= static_cast<int>(scene.materials.size())) return;
    const Material& current = nth(scene.materials, material);
    std::function<void()> fix;
    if (current.frequencyHz <= 0.0)
        fix = [&model, material] {
            addSound(model, material);
            hintOnMaterial(model, material);
        };
    showHint(model, current.name, silentBodyReason(scene, material), std::move(fix));
}

juce::String unsupportedFeatures(const SavedSession& session) {
    juce::StringArray unsupported;
    if (std::ranges::any_of(session.equalised, &EqualisedActuator::isKnown)) unsupported.add("equalisers");
    if (session.shaping != EventShaping{}) unsupported.add("method, remapping and gain");
    if (unsupported.isEmpty()) return {};
    return "This session has " + unsupported.joinIntoString(", ") +
           " of its own, which the mixer has not: it feels otherwise here; physvib render has them";
}

juce::String silenceReason(const MixerModel& model) {
    const Mix& mix = model.mix();
    const auto all = std::views::iota(0, mix.count());
    const auto isPlayed = [&](int j) { return model.device().isPlayed(static_cast<std::size_t>(j)); };
    if (masterGain(mix) == 0.0f) return "the master is at " + number(minStripDb, 0) + " dB";
    if (std::ranges::all_of(all, [&](int j) { return mix.isSilent(j); })) return "every strip is muted";
    const bool hasMonitor = !model.device().listening().settings().contacts.empty();
    if (!hasMonitor && std::ranges::none_of(all, isPlayed)) return "no strip has an output";
    if (!hasMonitor && std::ranges::none_of(all, [&](int j) { return isPlayed(j) && !mix.isSilent(j); }))
        return "every strip is muted, or has no output";
    const bool areFadersDown = std::ranges::all_of(
        all, [&](int j) { return maxGainDb(mix, static_cast<std::size_t>(j)) <= minStripDb; });
    return areFadersDown ? "every strip's fader is down" : "";
}

void hintOnLevels(MixerModel& model, const juce::String& reason) {
    constexpr const char* label = "levels-silent";
    if (reason.isEmpty()) return model.messages().withdraw(label);
    model.messages().show({"Nothing is felt: " + reason, false, {}, label});
}

void hintOnBody(MixerModel& model, const std::string& name) {
    const Scene& scene = model.world().drawing().drawn();
    const BodyDescription* const body = model.world().drawing().find(name);
    if (body == nullptr) return;
    std::function<void()> fix;
    if (!actionsToVibrate(scene, *body).empty())
        fix = [&model, name] {
            const auto* found = model.world().drawing().find(name); // it may have been erased meanwhile
            if (found == nullptr) return;
            if (!model.reportIfError(
                    model.world().edit(fixName, actionsToVibrate(model.world().drawing().drawn(), *found))))
                hintOnBody(model, name);
        };
    showHint(model, name, silentBodyReason(scene, *body), std::move(fix));
}

} // namespace physvib
