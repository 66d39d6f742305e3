// SPDX-License-Identifier: GPL-3.0-or-later
// Tries a material or a body in a world of its own, and reports what that world explains.
#include "Mixer/World/FeltHint.h"
#include "Mixer/Desk/DeskWords.h"
#include "Scene/Drawing/FeltTrial.h"
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
