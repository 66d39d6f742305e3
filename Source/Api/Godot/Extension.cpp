// SPDX-License-Identifier: MIT
// What Godot calls when it loads and unloads the extension.
#include "Api/Godot/State.h"
#include "Api/Godot/Worlds.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace physvib::godot {
namespace {
const Class* const classes[] = {&hapticMaterialClass, &hapticBodyClass, &hapticWorld2dClass,
                                &hapticWorld3dClass};

// The editor's help and tooltips, from doc_classes beside the folder bin of the library's system.
void loadHelp() {
    if (api.loadHelp == nullptr) return;
    Text library;
    api.libraryPath(api.library, library.get());
    const std::string folder =
        singleton("ProjectSettings").call("globalize_path", library.utf8().c_str()).text();
    const std::string addon = folder.substr(0, folder.rfind("/bin/")) + "/doc_classes/";
    for (const Class* type : classes) {
        const std::string path = addon + type->name + ".xml";
        std::ifstream file(std::filesystem::path(std::u8string(path.begin(), path.end())));
        const std::string xml((std::istreambuf_iterator<char>(file)), {});
        if (!xml.empty()) api.loadHelp(xml.c_str());
    }
}

constexpr const char* tooOld = "PhysVib: expected Godot 4.4 or newer\n";

void start(void*, GDExtensionInitializationLevel level) {
    if (level == GDEXTENSION_INITIALIZATION_SCENE) {
        if (!findStateMethods()) std::fputs(tooOld, stderr);
        for (const Class* type : classes) registerClass(*type);
    }
    if (level == GDEXTENSION_INITIALIZATION_EDITOR) loadHelp();
}

void stop(void*, GDExtensionInitializationLevel level) {
    if (level != GDEXTENSION_INITIALIZATION_SCENE) return;
    for (const Class* type : classes) api.unregisterClass(api.library, Name(type->name).get());
}
} // namespace

} // namespace physvib::godot

#ifdef _WIN32
#define PHYSVIB_SHOWN __declspec(dllexport)
#else
#define PHYSVIB_SHOWN __attribute__((visibility("default")))
#endif

extern "C" PHYSVIB_SHOWN GDExtensionBool physvib_godot_init(GDExtensionInterfaceGetProcAddress get,
                                                            GDExtensionClassLibraryPtr library,
                                                            GDExtensionInitialization* initialization) {
    if (!physvib::godot::lookUp(get, library)) {
        std::fputs(physvib::godot::tooOld, stderr);
        return 0;
    }
    initialization->minimum_initialization_level = GDEXTENSION_INITIALIZATION_SCENE;
    initialization->initialize = physvib::godot::start;
    initialization->deinitialize = physvib::godot::stop;
    return 1;
}
