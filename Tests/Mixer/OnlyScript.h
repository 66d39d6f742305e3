// SPDX-License-Identifier: GPL-3.0-or-later
// A script that stands in for a program of the system.
#pragma once
#include "MixerTesting.h"
#include <cstdlib>
#include <string>

namespace physvib::test {

/// The only program that is found is a script in its place, until the end.
class OnlyScript {
public:
    OnlyScript(const TestFolder& folder, const char* name, const juce::String& script)
        : path_{std::getenv("PATH")} {
        const auto file = folder("programs").getChildFile(name);
        file.create();
        file.replaceWithText("#!/bin/sh\nPATH=" + juce::String{path_} + "\n" + script, false, false, "\n");
        file.setExecutePermission(true);
        setenv("PATH", folder("programs").getFullPathName().toRawUTF8(), 1);
    }
    ~OnlyScript() { setenv("PATH", path_.c_str(), 1); }

private:
    const std::string path_;
};

} // namespace physvib::test
