// SPDX-License-Identifier: GPL-3.0-or-later
// A mixer's view with a new scene, to draw in.
#pragma once
#include "MixerTesting.h"
#include "Scene/SceneFile.h"

namespace physvib::test {

struct NewSceneRig : MixerInView {
    DrawPane& pane = view.world().drawing();
    WorldView& world = view.world().view();

    NewSceneRig() {
        view.setSize(1440, 900);
        model.setSlowness(0);
        model.change("New scene", [&](Mix& mix) {
            mix.scene = std::make_shared<const Scene>(newScene(*mix.scene, SceneGround::floor));
        });
        settle();
    }
    void settle() {
        model.dispatchPendingMessages();
        runFor(0.15); // the view shows the world as it is felt, L later: until then poses of the scene before
        runUntil([&] {
            return view.refresh(), std::ranges::all_of(drawn().bodies, [&](const BodyDescription& b) {
                       return world.poseOfBody(b.name).has_value();
                   });
        });
    }
    void undo() { model.undoManager().undo(); }
    /// As drawn; null: there is none.
    const BodyDescription* body(std::string_view name) { return model.world().drawing().find(name); }
    const Scene& drawn() { return model.world().drawing().drawn(); }
    Vector share(double x, double y) { return {x * drawn().fieldWidthMetres, y * drawn().fieldHeightMetres}; }
};

} // namespace physvib::test
