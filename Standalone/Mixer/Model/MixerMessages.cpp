// SPDX-License-Identifier: GPL-3.0-or-later
// The queue of messages, words for impacts, and trials of materials in a world of their own.
#include "Mixer/Model/MixerMessages.h"
#include "Core/NameNumbers.h"
#include "Mixer/Model/MixerModel.h"
#include "Scene/Drawing/FeltTrial.h"
#include <ranges>

namespace physvib {
namespace {

bool isOf(const MixerMessage& message, const juce::String& label) {
    return label.isNotEmpty() && message.label == label;
}

constexpr const char *feltLabel = "felt", *makeFelt = "Make it felt";

void showHint(MixerModel& model, const std::string& name, const std::string& why,
              std::function<void()> mend) {
    if (why.empty()) return model.messages().withdraw(feltLabel);
    MixerMessage message{utf8(name) + " is not felt at usual impacts: " + utf8(why), true, {}, feltLabel};
    if (mend) message.act = {makeFelt, std::move(mend)};
    model.messages().show(std::move(message));
}

/// The scene starts anew.
void giveSound(MixerModel& model, int material) {
    model.change(makeFelt, [&](Mix& mix) {
        mix.scene = std::make_shared<const Scene>(withSound(model.world().drawing().drawn(), material));
    });
}

} // namespace

void MixerMessages::put(MixerMessage message) {
    const bool isSame = message.words == shown_.words && message.isNews == shown_.isNews &&
                        message.act.name == shown_.act.name;
    shown_ = std::move(message);
    ++told_;
    if (!isSame) onChange_();
}

void MixerMessages::show(MixerMessage message) {
    const bool isDone = message.words.isEmpty();
    std::erase_if(waiting_, [&](const MixerMessage& m) { return isOf(m, message.label); });
    if (isDone && !waiting_.empty()) {
        message = std::move(waiting_.front());
        waiting_.pop_front();
    } else if (!isDone && shown_.lasts() && shown_.words != message.words && !isOf(shown_, message.label))
        waiting_.push_front(shown_); // there is still something to be done about it
    put(std::move(message));
}

void MixerMessages::add(MixerMessage message) {
    if (shown_.words.isEmpty() || isOf(shown_, message.label)) return put(std::move(message));
    const auto same =
        std::ranges::find_if(waiting_, [&](const MixerMessage& m) { return isOf(m, message.label); });
    if (same != waiting_.end())
        *same = std::move(message);
    else
        waiting_.push_back(std::move(message));
}

void MixerMessages::withdraw(const juce::String& label) {
    std::erase_if(waiting_, [&](const MixerMessage& m) { return isOf(m, label); });
    if (isOf(shown_, label)) show({});
}

int materialOf(const Scene& scene, const CollisionEvent& hit) {
    const auto sounds = [&hit](const Material& m) { return hit.sound == soundOfMaterial(m.name); };
    const auto found = std::ranges::find_if(scene.materials, sounds);
    return found == scene.materials.end() ? -1 : static_cast<int>(found - scene.materials.begin());
}

juce::String materialName(const Scene& scene, const CollisionEvent& hit) {
    const int index = materialOf(scene, hit);
    return isClip(hit.sound) ? juce::String{"clip"}
           : index < 0       ? juce::String{"hit"}
                             : utf8(nth(scene.materials, index).name);
}

StrongestActuator strongestOf(const MixerModel& model, const CollisionEvent& hit) {
    const Mix& mix = model.mix();
    PhantomPanner::Gains gains{};
    mix.panner().gainsAt(hit, gains);
    StrongestActuator strongest;
    for (int j = 0; j < mix.count(); ++j) {
        const auto i = static_cast<std::size_t>(j);
        const double g =
            std::abs(hit.amplitude) * gains[i] * mix.layout.enchanters[i].fullScaleG * masterGain(mix);
        if (g > strongest.levelG && model.device().isPlayed(i) && !mix.isSilent(j)) strongest = {j, g};
    }
    return strongest;
}

juce::String whyOnlySeen(const MixerModel& model, const CollisionEvent& hit) {
    if (model.isOnlySeen()) return "no device";
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
    const Material& asked = nth(scene.materials, material);
    std::function<void()> mend;
    if (asked.frequencyHz <= 0.0)
        mend = [&model, material] {
            giveSound(model, material);
            hintOnMaterial(model, material);
        };
    showHint(model, asked.name, whyNotFelt(scene, material), std::move(mend));
}

juce::String lackingOf(const SavedSession& session) {
    juce::StringArray lacking;
    if (std::ranges::any_of(session.equalised, &EqualisedActuator::isKnown)) lacking.add("equalisers");
    if (session.shaping != EventShaping{}) lacking.add("method, remapping and gain");
    if (lacking.isEmpty()) return {};
    return "This session has " + lacking.joinIntoString(", ") +
           " of its own, which the mixer has not: it feels otherwise here; physvib render has them";
}

juce::String whySilent(const MixerModel& model) {
    const Mix& mix = model.mix();
    const auto all = std::views::iota(0, mix.count());
    const auto isPlayed = [&](int j) { return model.device().isPlayed(static_cast<std::size_t>(j)); };
    if (masterGain(mix) == 0.0f) return "the master is at " + number(leastStripDb, 0) + " dB";
    if (std::ranges::all_of(all, [&](int j) { return mix.isSilent(j); })) return "every strip is muted";
    const bool isHeard = !model.device().listening().settings().contacts.empty();
    if (!isHeard && std::ranges::none_of(all, isPlayed)) return "no strip has an output";
    if (!isHeard && std::ranges::none_of(all, [&](int j) { return isPlayed(j) && !mix.isSilent(j); }))
        return "every strip is muted, or has no output";
    const bool areDown = std::ranges::all_of(
        all, [&](int j) { return loudestDb(mix, static_cast<std::size_t>(j)) <= leastStripDb; });
    return areDown ? "every strip's fader is down" : "";
}

void hintOnLevels(MixerModel& model, const juce::String& why) {
    constexpr const char* label = "levels-silent";
    if (why.isEmpty()) return model.messages().withdraw(label);
    model.messages().show({"Nothing is felt: " + why, false, {}, label});
}

void hintOnBody(MixerModel& model, const std::string& name) {
    const Scene& scene = model.world().drawing().drawn();
    const BodyDescription* const body = model.world().drawing().find(name);
    if (body == nullptr) return;
    std::function<void()> mend;
    if (!feltChanges(scene, *body).empty())
        mend = [&model, name] {
            const auto* there = model.world().drawing().find(name); // it may have been erased meanwhile
            if (there == nullptr) return;
            if (!model.reportFault(
                    model.world().edit(makeFelt, feltChanges(model.world().drawing().drawn(), *there))))
                hintOnBody(model, name);
        };
    showHint(model, name, whyNotFelt(scene, *body), std::move(mend));
}

} // namespace physvib
