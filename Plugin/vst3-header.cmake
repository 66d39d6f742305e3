# SPDX-License-Identifier: GPL-3.0-or-later
# JUCE 7.0.5's VST3 wrapper copies the channel map of every input bus in every block, also of one that is off, which takes memory in the render
# call; later versions refer to it. The header in which it does is written here with that one word mended, into the folder
# `physvib_vst3_headers`, which the wrapper searches before JUCE's own.
set(header juce_audio_processors/format_types/juce_VST3Common.h)
set(copied "const auto mapping = map[busIndex];")
set(referred "const auto& mapping = map[busIndex];")
set(physvib_vst3_headers ${CMAKE_CURRENT_BINARY_DIR}/vst3)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${juce_modules}/${header})

file(READ ${juce_modules}/${header} text)
string(REPLACE "${copied}" "${referred}" text "${text}")
string(FIND "${text}" "${referred}" found)
if(found EQUAL -1)
    message(FATAL_ERROR "${juce_modules}/${header}: expected \"${copied}\", which takes memory in the render call, to mend it: found no such line")
endif()
set(written "")
if(EXISTS ${physvib_vst3_headers}/${header})
    file(READ ${physvib_vst3_headers}/${header} written)
endif()
if(NOT "${text}" STREQUAL "${written}") # or all wrappers would be compiled whenever CMake runs
    file(WRITE ${physvib_vst3_headers}/${header} "${text}")
endif()
