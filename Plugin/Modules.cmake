# SPDX-License-Identifier: GPL-3.0-or-later
get_target_property(juce_modules juce::juce_core INTERFACE_JUCE_MODULE_PATH)
add_library(physvib-plugin-entry OBJECT Entry.cpp)
add_library(physvib-lv2-entry OBJECT Lv2Entry.cpp Lv2Window.cpp)
target_compile_definitions(physvib-lv2-entry PRIVATE PHYSVIB_LV2_ENTRY)
foreach(entry physvib-plugin-entry physvib-lv2-entry)
    target_link_libraries(${entry} PRIVATE physvib-plugin)
    physvib_seldom(${entry})
endforeach()
set(physvib_entry_points ${CMAKE_CURRENT_LIST_DIR}/entry-points.map)
include(${CMAKE_CURRENT_LIST_DIR}/vst3-header.cmake)

# physvib_plugin(TARGET NAME CODE LV2URI BUSES CHANNELS MUSIC_PORTS FORMATS...): NAME.vst3, NAME.lv2, NAME.component in plugins/
# (spaces of the name become hyphens).
# A module shows hosts its format's entry points and nothing else, so that no two share a static. It stays loaded, as the
# shared statics kept it: threads of JUCE and of X11's handlers may outlast the last instance.
# CODE (four characters) and LV2URI are promises: hosts find our instances by them.
function(physvib_plugin target name code lv2uri buses channels music_ports)
    string(REPLACE " " "-" file ${name})
    set(is_synth TRUE)
    set(categories Instrument Generator)
    set(au_type kAudioUnitType_MusicDevice)
    if(music_ports) # an effect: music comes in by its main bus
        set(is_synth FALSE)
        set(categories Fx)
        set(au_type kAudioUnitType_MusicEffect)
    endif()
    juce_add_plugin(${target}
        FORMATS ${ARGN}
        PLUGIN_NAME ${name}
        PRODUCT_NAME ${file}
        DESCRIPTION "Collisions one can feel: each channel drives a vibration module"
        VERSION ${PROJECT_VERSION}
        COMPANY_NAME PhysVib
        LV2URI https://unused # where a package does not lose it, the definition below still comes first
        BUNDLE_ID org.physvib.${target}
        PLUGIN_MANUFACTURER_CODE PhVb
        PLUGIN_CODE ${code}
        IS_SYNTH ${is_synth}
        NEEDS_MIDI_INPUT TRUE
        VST3_CATEGORIES ${categories}
        AU_MAIN_TYPE ${au_type}
        ${physvib_vst3_manifest})
    get_target_property(linked ${target} LINK_LIBRARIES)
    list(REMOVE_ITEM linked juce::juce_audio_plugin_client) # from 8 on: all of JUCE, compiled once more for each
    set_target_properties(${target} PROPERTIES LINK_LIBRARIES "${linked}")
    target_sources(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/Module.cpp $<TARGET_OBJECTS:physvib-plugin-entry>)
    target_compile_definitions(${target} PUBLIC PHYSVIB_BUSES=${buses} PHYSVIB_CHANNELS=${channels} PHYSVIB_MUSIC_PORTS=${music_ports} JUCE_VST3_CAN_REPLACE_VST2=0
        JucePlugin_LV2URI="${lv2uri}") # juce_add_plugin's own argument is lost in Debian's package
    target_link_libraries(${target} PUBLIC physvib-plugin)
    set(plugins ${CMAKE_BINARY_DIR}/plugins)
    foreach(module ${target} ${target}_VST3 ${target}_LV2)
        if(TARGET ${module})
            physvib_seldom(${module}) # it hands blocks over
        endif()
    endforeach()
    foreach(module ${target}_VST3 ${target}_LV2)
        if(TARGET ${module} AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
            set_target_properties(${module} PROPERTIES LINK_DEPENDS ${physvib_entry_points})
            target_link_options(${module} PRIVATE LINKER:--version-script=${physvib_entry_points} LINKER:-z,nodelete)
        endif()
    endforeach()
    if(TARGET ${target}_VST3)
        target_include_directories(${target}_VST3 SYSTEM BEFORE PRIVATE ${physvib_vst3_headers})
        target_sources(${target}_VST3 PRIVATE ${physvib_vst3_wrapper})
        set_target_properties(${target}_VST3 PROPERTIES LIBRARY_OUTPUT_DIRECTORY
            $<IF:$<PLATFORM_ID:Linux>,${plugins}/${file}.vst3/Contents/${CMAKE_SYSTEM_PROCESSOR}-linux,${plugins}>)
    endif()
    if(TARGET ${target}_LV2)
        set_target_properties(${target}_LV2 PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY "${plugins}/${file}.lv2")
        target_sources(${target}_LV2 PRIVATE ${physvib_lv2_wrapper} $<TARGET_OBJECTS:physvib-lv2-entry>)
        add_dependencies(${target}_LV2 physvib-lv2-ports)
        add_custom_command(TARGET ${target}_LV2 POST_BUILD VERBATIM # after JUCE's command, which writes it
            COMMAND ${CMAKE_COMMAND} -DFOLDER=${plugins}/${file}.lv2 -DPORTS=$<TARGET_FILE:physvib-lv2-ports>
                -P ${CMAKE_CURRENT_SOURCE_DIR}/lv2-description.cmake)
    endif()
    foreach(format vst3 lv2) # where hosts look
        string(TOUPPER ${format} module)
        if(PHYSVIB_INSTALL AND TARGET ${target}_${module}) # its folder is there before it is built
            physvib_installs(plugins $<TARGET_FILE:${target}_${module}>)
            install(DIRECTORY ${plugins}/${file}.${format} DESTINATION lib/${format} COMPONENT plugins USE_SOURCE_PERMISSIONS)
        endif()
    endforeach()
    if(TARGET ${target}_AU)
        set_target_properties(${target}_AU PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${plugins})
    endif()
endfunction()

add_executable(physvib-lv2-ports EXCLUDE_FROM_ALL Lv2Ports.cpp Parameters.cpp)
target_link_libraries(physvib-lv2-ports PRIVATE PhysVib::Core physvib-warnings)

if(NOT PHYSVIB_SANITIZE) # a sanitized module would need a sanitized host
    physvib_plugin(PhysVibPlugin "PhysVib" Phys urn:physvib:plugin oneBus 4 0 VST3 LV2 AU)
    physvib_plugin(PhysVibPairs "PhysVib Pairs" Phyp urn:physvib:plugin:pairs manyBuses 2 0 VST3 AU) # hosts without wide buses
    physvib_plugin(PhysVib2 "PhysVib 2" Phy2 urn:physvib:plugin:2 oneBus 2 0 LV2) # LV2 cannot be asked for another width
    physvib_plugin(PhysVib8 "PhysVib 8" Phy8 urn:physvib:plugin:8 oneBus 8 0 LV2)
    physvib_plugin(PhysVib16 "PhysVib 16" PhyG urn:physvib:plugin:16 oneBus 16 0 LV2)
    physvib_plugin(PhysVibMusic "PhysVib Music" PhyM urn:physvib:plugin:music oneBus 4 2 VST3 LV2 AU) # nor has it ports that are off: decision 143
endif()

if(PHYSVIB_CLAP_HEADERS AND NOT PHYSVIB_SANITIZE) # four channels
    add_library(PhysVibPlugin_CLAP MODULE Clap.cpp)
    target_include_directories(PhysVibPlugin_CLAP SYSTEM PRIVATE ${PHYSVIB_CLAP_HEADERS})
    target_compile_definitions(PhysVibPlugin_CLAP PRIVATE PHYSVIB_VERSION="${PHYSVIB_VERSION}")
    target_link_libraries(PhysVibPlugin_CLAP PRIVATE physvib-plugin physvib-warnings)
    target_link_options(PhysVibPlugin_CLAP PRIVATE LINKER:--version-script=${physvib_entry_points} LINKER:-z,nodelete)
    set_target_properties(PhysVibPlugin_CLAP PROPERTIES PREFIX "" OUTPUT_NAME PhysVib SUFFIX .clap LINK_DEPENDS ${physvib_entry_points}
        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/plugins)
endif()
