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

# physvib_write(FILE): `text`, where it is another; or all wrappers would be compiled whenever CMake runs.
function(physvib_write file)
    set(written "")
    if(EXISTS ${file})
        file(READ ${file} written)
    endif()
    if(NOT "${text}" STREQUAL "${written}")
        file(WRITE ${file} "${text}")
    endif()
endfunction()

string(FIND "${text}" "const auto& mapping = map[busIndex];" place)
if(place EQUAL -1)
    physvib_mend("blocks that take no memory" "const auto mapping = map[busIndex];" "const auto& mapping = map[busIndex];")
endif()
physvib_mend("points of parameters" "\nnamespace juce\n{" "\n#include \"Vst3Points.h\"\n\nnamespace juce\n{")
physvib_mend("points of parameters" "    void updateFromProcessor (const AudioProcessor& processor)\n    {\n"
    "    const AudioProcessor* physvibInstance = nullptr;\n    void updateFromProcessor (const AudioProcessor& processor)\n    {\n        physvibInstance = &processor;\n")
physvib_mend("points of parameters" "                                hostData)\n    {}\n" "                                hostData)\n    { physvibPoints.emplace (mapperIn.physvibInstance, hostData.inputParameterChanges); physvibNotes.emplace (mapperIn.physvibInstance, hostData.inputEvents); }\n")
physvib_mend("points of parameters" "    AudioBuffer<FloatType> buffer;\n\nprivate:\n    void copyToHostOutputBuses"
    "    AudioBuffer<FloatType> buffer;\n    std::optional<physvib::Vst3Points> physvibPoints;\n    std::optional<physvib::Vst3Notes> physvibNotes;\n\nprivate:\n    void copyToHostOutputBuses")

physvib_write(${physvib_vst3_headers}/${header})

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
physvib_mend("notes with all that is said of them" "MidiEventList::toMidiBuffer (midiBuffer, *data.inputEvents);" "{} // Vst3Points.h reads them")
physvib_mend("notes with all that is said of them" "                               public Vst::IMidiMapping," "                               public Vst::IMidiMapping,\n                               public physvib::Vst3Expressions,")
physvib_mend("notes with all that is said of them" "UniqueBase<Vst::IMidiMapping>{}," "UniqueBase<Vst::IMidiMapping>{},\n                                             UniqueBase<Vst::INoteExpressionController>{},")
physvib_mend("blocks without a lock, for we suspend nothing" "const ScopedLock sl (pluginInstance->getCallbackLock());" "")
physvib_write(${physvib_vst3_wrapper})
set_source_files_properties(${juce_modules}/juce_audio_plugin_client/juce_audio_plugin_client_VST3.cpp PROPERTIES HEADER_FILE_ONLY TRUE) # which includes JUCE's
set_source_files_properties(${physvib_vst3_wrapper} PROPERTIES COMPILE_OPTIONS "-w;-I${juce_modules}/juce_audio_plugin_client/VST3") # where it looks for what stands beside it

# LV2's wrapper takes that lock as well, and copies MIDI into a buffer that takes memory in a flood: Lv2Entry.cpp reads it where it lies.
set(mended_file ${juce_modules}/juce_audio_plugin_client/LV2/juce_LV2_Client.cpp)
if(NOT EXISTS ${mended_file}) # as of JUCE 8
    set(mended_file ${juce_modules}/juce_audio_plugin_client/juce_audio_plugin_client_LV2.cpp)
endif()
set(physvib_lv2_wrapper ${CMAKE_CURRENT_BINARY_DIR}/vst3/physvib_LV2_Client.cpp)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${mended_file})
file(READ ${mended_file} text)
string(REPLACE "\r\n" "\n" text "${text}")
physvib_mend("blocks without a lock" "const ScopedLock lock { processor->getCallbackLock() };" "")
physvib_mend("blocks that take no memory" "midi.addEvent (event + 1, static_cast<int> (event->body.size), static_cast<int> (event->time.frames));" "{}")
physvib_write(${physvib_lv2_wrapper})
set_source_files_properties(${juce_modules}/juce_audio_plugin_client/juce_audio_plugin_client_LV2.cpp PROPERTIES HEADER_FILE_ONLY TRUE)
set_source_files_properties(${physvib_lv2_wrapper} PROPERTIES COMPILE_OPTIONS "-w;-I${juce_modules}/juce_audio_plugin_client/LV2"
    COMPILE_DEFINITIONS "lv2_descriptor=juceLv2Descriptor;lv2ui_descriptor=juceLv2UiDescriptor")
