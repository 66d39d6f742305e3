// SPDX-License-Identifier: MIT
// The entry point of the extension: registers its classes and their help in Godot, and removes them.
#include "Api/Godot/State.h"
#include "Api/Godot/Worlds.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace physvib::godot {
namespace {
const ClassTable* const classes[] = {&hapticMaterialClass, &hapticBodyClass, &hapticWorld2dClass,
                                     &hapticWorld3dClass};

// Loads the editor's help and tooltips from doc_classes, which lies beside the library's folder bin.
void loadHelp() {
    if (api.loadHelp == nullptr) return;
    String library;
    api.getLibraryPath(api.library, library.get());
    const std::string folder =
        singleton("ProjectSettings").call("globalize_path", library.utf8().c_str()).text();
    const std::string addon = folder.substr(0, folder.rfind("/bin/")) + "/doc_classes/";
    for (const ClassTable* table : classes) {
        const std::string path = addon + table->name + ".xml";
        std::ifstream file(std::filesystem::path(std::u8string(path.begin(), path.end())));
        const std::string xml((std::istreambuf_iterator<char>(file)), {});
        if (!xml.empty()) api.loadHelp(xml.c_str());
    }
}

constexpr const char* tooOld = "PhysVib: expected Godot 4.4 or newer\n";

void start(void*, GDExtensionInitializationLevel level) {
    if (level == GDEXTENSION_INITIALIZATION_SCENE) {
        if (!findStateMethods()) std::fputs(tooOld, stderr);
        for (const ClassTable* table : classes) registerClass(*table);
    }
    if (level == GDEXTENSION_INITIALIZATION_EDITOR) loadHelp();
}

void stop(void*, GDExtensionInitializationLevel level) {
    if (level != GDEXTENSION_INITIALIZATION_SCENE) return;
    for (const ClassTable* table : classes) api.unregisterClass(api.library, StringName(table->name).get());
}
} // namespace

} // namespace physvib::godot

#ifdef _WIN32
#define PHYSVIB_ENTRY __declspec(dllexport)
#else
#define PHYSVIB_ENTRY __attribute__((visibility("default")))
#endif

extern "C" PHYSVIB_ENTRY GDExtensionBool physvib_godot_init(GDExtensionInterfaceGetProcAddress getAddress,
                                                            GDExtensionClassLibraryPtr library,
                                                            GDExtensionInitialization* initialization) {
    if (!physvib::godot::loadFunctions(getAddress, library)) {
        std::fputs(physvib::godot::tooOld, stderr);
        return 0;
    }
    initialization->minimum_initialization_level = GDEXTENSION_INITIALIZATION_SCENE;
    initialization->initialize = physvib::godot::start;
    initialization->deinitialize = physvib::godot::stop;
    return 1;
}
