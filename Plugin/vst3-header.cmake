# SPDX-License-Identifier: GPL-3.0-or-later
# JUCE 7.0.5's VST3 wrapper copies the channel map of every input bus in every block, also of one that is off, which takes memory in the render
# call (later versions refer to it), and of a parameter's points it reads the last of each block alone. The header in which the host's block
# becomes JUCE's is written here with that one word mended and with a line that hands the points over (Vst3Points.h), into the folder
# `physvib_vst3_headers`, which the wrapper searches before JUCE's own.
set(header juce_audio_processors/format_types/juce_VST3Common.h)
set(physvib_vst3_headers ${CMAKE_CURRENT_BINARY_DIR}/vst3)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${juce_modules}/${header})
file(READ ${juce_modules}/${header} text)

# physvib_mend(PURPOSE FOUND WRITTEN): FOUND becomes WRITTEN in `text`.
function(physvib_mend purpose found written)
    string(FIND "${text}" "${found}" place)
    if(place EQUAL -1)
        message(FATAL_ERROR "${juce_modules}/${header}: expected \"${found}\", to mend it for ${purpose}: found no such text")
    endif()
    string(REPLACE "${found}" "${written}" mended "${text}")
    set(text "${mended}" PARENT_SCOPE)
endfunction()

string(FIND "${text}" "const auto& mapping = map[busIndex];" place)
if(place EQUAL -1)
    physvib_mend("blocks that take no memory" "const auto mapping = map[busIndex];" "const auto& mapping = map[busIndex];")
endif()
physvib_mend("points of parameters" "#ifndef DOXYGEN\n\nnamespace juce\n{" "#ifndef DOXYGEN\n\n#include \"Vst3Points.h\"\n\nnamespace juce\n{")
physvib_mend("points of parameters" "    void updateFromProcessor (const AudioProcessor& processor)\n    {\n"
    "    const AudioProcessor* physvibInstance = nullptr;\n    void updateFromProcessor (const AudioProcessor& processor)\n    {\n        physvibInstance = &processor;\n")
physvib_mend("points of parameters" "                                hostData)\n    {}\n" "                                hostData)\n    { physvibPoints.emplace (mapperIn.physvibInstance, hostData.inputParameterChanges); }\n")
physvib_mend("points of parameters" "    AudioBuffer<FloatType> buffer;\n\nprivate:\n    void copyToHostOutputBuses"
    "    AudioBuffer<FloatType> buffer;\n    std::optional<physvib::Vst3Points> physvibPoints;\n\nprivate:\n    void copyToHostOutputBuses")

set(written "")
if(EXISTS ${physvib_vst3_headers}/${header})
    file(READ ${physvib_vst3_headers}/${header} written)
endif()
if(NOT "${text}" STREQUAL "${written}") # or all wrappers would be compiled whenever CMake runs
    file(WRITE ${physvib_vst3_headers}/${header} "${text}")
endif()
