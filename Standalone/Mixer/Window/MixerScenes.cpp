// SPDX-License-Identifier: GPL-3.0-or-later
// Saves the drawing as a scene file, and creates empty scenes to draw in.
#include "Io/Disk/AtomicFile.h"
#include "Mixer/Window/MixerWindow.h"
#include "Mixer/Window/Parts.h"
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneFile.h"
#include "Scene/SceneValidation.h"

namespace physvib {

void MixerWindow::saveScene(bool isNow) {
    files_.scenesFolder().createDirectory();
    chooseFile(
        "Save as scene", ".json", true,
        [this, isNow](const juce::File& file) {
            if (const auto error = saveSceneTo(file, isNow); !error.empty()) return say(utf8(error));
            tellSaved("Saved the scene", file);
        },
        "scene", files_.scenesFolder());
}

std::string MixerWindow::saveSceneTo(const juce::File& file, bool isNow) {
    const auto& world = desk_->world();
    Scene scene = world.drawing().drawn();
    if (isNow) scene = sceneNow(scene, world.posesNow());
    scene.name = file.getFileNameWithoutExtension().toStdString();
    scene.variables.clear();
    if (auto fault = validate(scene); !fault.empty()) return fault;
    auto error = writeFile(file.getFullPathName().toStdString(), sceneJson(scene));
    if (error.empty()) view_->topBar().setOwnScenes(files_.ownScenes());
    return error;
}

void MixerWindow::recordScript() {
    auto& script = desk_->script();
    script.isRecording() ? script.stop() : script.start();
    if (script.isRecording()) view_->world().drawing().use(DrawTool::hand);
}

void MixerWindow::newScene(SceneGround ground) {
    desk_->change("New scene", [&](Mix& mix) {
        mix.scene =
            std::make_shared<const Scene>(physvib::newScene(desk_->world().drawing().drawn(), ground));
    });
    view_->world().drawing().use(DrawTool::ball);
}

} // namespace physvib
