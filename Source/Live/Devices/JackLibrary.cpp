// SPDX-License-Identifier: MIT
// Loads all of JACK's functions, or none.
#include "Live/Devices/JackLibrary.h"
#include "Live/Pads/SharedLibrary.h"
#include <initializer_list>

namespace physvib {
namespace {

struct LoadedJack {
    JackLibrary jack;
    bool isWhole = true;
};

LoadedJack loadJack() {
    LoadedJack loaded;
    void* library = nullptr;
    for (const char* name : {"libjack.so.0", "libjack64.dll", "libjack.0.dylib"})
        if (library == nullptr) library = openLibrary(name);
    if (library == nullptr) return {{}, false};
#define PHYSVIB_JACK_FIND(name)                                                                              \
    loaded.jack.name = reinterpret_cast<decltype(loaded.jack.name)>(functionIn(library, "jack_" #name));     \
    loaded.isWhole = loaded.isWhole && loaded.jack.name != nullptr;
    PHYSVIB_JACK_FUNCTIONS(PHYSVIB_JACK_FIND)
#undef PHYSVIB_JACK_FIND
    if (!loaded.isWhole) return loaded;
    // Without a running server, JACK prints five lines to stderr for each query. The caller says it in one.
    loaded.jack.set_error_function([](const char*) {});
    loaded.jack.set_info_function([](const char*) {});
    return loaded;
}

} // namespace

const JackLibrary* jackLibrary() {
    static const LoadedJack loaded = loadJack();
    return loaded.isWhole ? &loaded.jack : nullptr;
}

} // namespace physvib
