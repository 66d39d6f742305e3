# SPDX-License-Identifier: GPL-3.0-or-later
# JUCE 7.0.5's VST3 wrapper copies the channel map of every input bus in every block, also of one that is off, which takes memory in the render
# call (later versions refer to it), and of a parameter's points it reads the last of each block alone. The header in which the host's block
# becomes JUCE's is written here with that one word mended and with a line that hands the points over (Vst3Points.h), into the folder
# `physvib_vst3_headers`, which the wrapper searches before JUCE's own.
set(header juce_audio_processors/format_types/juce_VST3Common.h)
if(NOT EXISTS ${juce_modules}/${header}) # as of JUCE 9
    set(header juce_audio_processors_headless/format_types/juce_VST3Common.h)
endif()
set(physvib_vst3_headers ${CMAKE_CURRENT_BINARY_DIR}/vst3)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${juce_modules}/${header})
set(mended_file ${juce_modules}/${header})
file(READ ${mended_file} text)

# physvib_mend(PURPOSE FOUND WRITTEN): FOUND becomes WRITTEN in `text`.
function(physvib_mend purpose found written)
    string(FIND "${text}" "${found}" place)
    if(place EQUAL -1)
        message(FATAL_ERROR "${mended_file}: expected \"${found}\", to mend it for ${purpose}: found no such text")
    endif()
    string(REPLACE "${found}" "${written}" mended "${text}")
    set(text "${mended}" PARENT_SCOPE)
endfunction()

string(FIND "${text}" "const auto& mapping = map[busIndex];" place)
if(place EQUAL -1)
    physvib_mend("blocks that take no memory" "const auto mapping = map[busIndex];" "const auto& mapping = map[busIndex];")
endif()
physvib_mend("points of parameters" "\nnamespace juce\n{" "\n#include \"Vst3Points.h\"\n\nnamespace juce\n{")
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

# MIDI controllers come to VST3 as parameters that stand for them: JUCE makes 2,080, one for each controller of each channel. The plug-in tells
# channels apart for bend, pressure, slide (CC 74) and pedal (CC 64) alone; the stand-ins of the others are those of the first channel, for all of
# them (decision 93). Numbers stay. JUCE's wrapper is compiled in that wording instead of its own.
set(wrapper juce_audio_plugin_client/VST3/juce_VST3_Wrapper.cpp)
if(NOT EXISTS ${juce_modules}/${wrapper}) # as of JUCE 8
    set(wrapper juce_audio_plugin_client/juce_audio_plugin_client_VST3.cpp)
    set(physvib_vst3_manifest VST3_AUTO_MANIFEST FALSE) # or it would run each module to describe it in a file
endif()
set(physvib_vst3_wrapper ${CMAKE_CURRENT_BINARY_DIR}/vst3/physvib_VST3_Wrapper.cpp)
set(mended_file ${juce_modules}/${wrapper})
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${mended_file})
file(READ ${mended_file} text)
string(REPLACE "\r\n" "\n" text "${text}")
set(number "static_cast<Vst::ParamID> (p) + parameterToMidiControllerOffset")
physvib_mend("fewer stand-ins of controllers" "                midiControllerToParameter[c][i] = ${number}"
"                const bool physvibHasOwn = c == 0 || i == Vst::kAfterTouch || i == Vst::kPitchBend || i == 74 || i == 64;
                midiControllerToParameter[c][i] = physvibHasOwn ? ${number} : midiControllerToParameter[0][i]")
physvib_mend("fewer stand-ins of controllers" "                parameters.addParameter (new Vst::Parameter (toString (\"MIDI CC \"" "                if (physvibHasOwn)\n                parameters.addParameter (new Vst::Parameter (toString (\"MIDI CC \"")
set(written "")
if(EXISTS ${physvib_vst3_wrapper})
    file(READ ${physvib_vst3_wrapper} written)
endif()
if(NOT "${text}" STREQUAL "${written}")
    file(WRITE ${physvib_vst3_wrapper} "${text}")
endif()
set_source_files_properties(${juce_modules}/juce_audio_plugin_client/juce_audio_plugin_client_VST3.cpp PROPERTIES HEADER_FILE_ONLY TRUE) # which includes JUCE's
set_source_files_properties(${physvib_vst3_wrapper} PROPERTIES COMPILE_OPTIONS "-w;-I${juce_modules}/juce_audio_plugin_client/VST3") # where it looks for what stands beside it
