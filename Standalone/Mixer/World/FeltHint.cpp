// SPDX-License-Identifier: GPL-3.0-or-later
// Tries a material or a body in a world of its own, and reports what that world explains.
#include "Mixer/World/FeltHint.h"
#include "Live/Documents/Mix.h"
#include "Mixer/Desk/DeskWords.h"
#include "Mixer/Window/Parts.h"
#include "Scene/Drawing/FeltTrial.h"
#include <algorithm>
#include <ranges>
#include <utility>

namespace physvib {
namespace {

constexpr const char *feltLabel = "felt", *makeFelt = "Make it felt";

void showHint(Desk& desk, const std::string& name, const std::string& why, std::function<void()> mend) {
    if (why.empty()) return desk.messages().withdraw(feltLabel);
    DeskMessage message{utf8(name) + " is not felt at usual impacts: " + utf8(why), true, {}, feltLabel};
    if (mend) message.act = {makeFelt, std::move(mend)};
    desk.messages().show(std::move(message));
}

/// The scene starts anew.
void giveSound(Desk& desk, int material) {
    desk.change(makeFelt, [&](Mix& mix) {
        mix.scene = std::make_shared<const Scene>(withSound(desk.world().drawing().drawn(), material));
    });
}

} // namespace

void hintOnMaterial(Desk& desk, int material) {
    const Scene& scene = desk.world().drawing().drawn();
    if (material < 0 || material >= static_cast<int>(scene.materials.size())) return;
    const Material& asked = scene.materials[static_cast<std::size_t>(material)];
    std::function<void()> mend;
    if (asked.frequencyHz <= 0.0)
        mend = [&desk, material] {
            giveSound(desk, material);
            hintOnMaterial(desk, material);
        };
    showHint(desk, asked.name, whyNotFelt(scene, material), std::move(mend));
}

juce::String whySilent(const Mix& mix) {
    const auto all = std::views::iota(0, mix.count());
    if (masterGain(mix) == 0.0f)
        return "the master is at " + number(leastStripDb, 0) + " dB, which is silent";
    if (std::ranges::all_of(all, [&](int j) { return mix.isSilent(j); })) return "every strip is muted";
    const bool areDown = std::ranges::all_of(
        all, [&](int j) { return loudestDb(mix, static_cast<std::size_t>(j)) <= leastStripDb; });
    return areDown ? "every strip's fader is at silence" : "";
}

void hintOnLevels(Desk& desk, const juce::String& why) {
    constexpr const char* label = "levels-silent";
    if (why.isEmpty()) return desk.messages().withdraw(label);
    desk.messages().show({"Nothing is felt: " + why, false, {}, label});
}

void hintOnBody(Desk& desk, const std::string& name) {
    const Scene& scene = desk.world().drawing().drawn();
    const BodyDescription* const body = desk.world().drawing().find(name);
    if (body == nullptr) return;
    std::function<void()> mend;
    if (!feltChanges(scene, *body).empty())
        mend = [&desk, name] {
            const auto* there = desk.world().drawing().find(name); // it may have been erased meanwhile
            if (there == nullptr) return;
            const auto error =
                desk.world().edit(makeFelt, feltChanges(desk.world().drawing().drawn(), *there));
            if (!error.empty()) return desk.report(utf8(error));
            hintOnBody(desk, name);
        };
    showHint(desk, name, whyNotFelt(scene, *body), std::move(mend));
}

} // namespace physvib
