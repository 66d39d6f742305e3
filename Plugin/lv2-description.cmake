# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DFOLDER=PhysVib.lv2 -DPORTS=physvib-lv2-ports -P lv2-description.cmake: what JUCE's generator of LV2 descriptions
# gets wrong, put right; the option that our entry reads; and a control port for each parameter instead of a property.
# Once done it finds nothing more to do.
file(READ "${FOLDER}/dsp.ttl" text)
# Numbers of parameters are floats; without a point they are read as whole numbers, of another type than the range says.
string(REGEX REPLACE "((lv2:default|lv2:minimum|lv2:maximum|rdf:value) -?[0-9]+)([ \t\n])" "\\1.0\\3" text "${text}")
# Neither is known; an empty address is that of the file.
string(REGEX REPLACE "\t\tfoaf:(homepage|mbox) <> ;\n" "" text "${text}")
# What has a maintainer and releases is a project.
string(REPLACE "\ta lv2:InstrumentPlugin ;\n" "\ta lv2:InstrumentPlugin , doap:Project ;\n" text "${text}")
string(REPLACE "\t\tbufs:maxBlockLength .\n" "\t\tbufs:maxBlockLength , bufs:nominalBlockLength .\n" text "${text}")
# Our entry has them for a host that has not.
string(REPLACE "lv2:requiredFeature\n\t\turid:map" "lv2:optionalFeature\n\t\turid:map" text "${text}")
# An effect is classed as one, and applied by hosts that know audio and controls only.
if(NOT text MATCHES "lv2:InstrumentPlugin")
    string(REPLACE "\ta lv2:Plugin ;\n" "\ta lv2:FilterPlugin , doap:Project ;\n" text "${text}")
    string(REGEX REPLACE "(lv2:(InputPort|OutputPort) , atom:AtomPort ;\n)(\t\trsz)" "\\1\t\tlv2:portProperty lv2:connectionOptional ;\n\\3" text "${text}")
endif()
# Ports are called as the enchanters that they drive: A, B, ...
foreach(number RANGE 1 26)
    math(EXPR letter "64 + ${number}")
    string(ASCII ${letter} label)
    string(REPLACE "lv2:name \"Audio Out ${number}\"" "lv2:name \"${label}\"" text "${text}")
endforeach()
# Music comes in on its left and its right.
string(REPLACE "lv2:name \"Audio In 1\"" "lv2:name \"Music left\"" text "${text}")
string(REPLACE "lv2:name \"Audio In 2\"" "lv2:name \"Music right\"" text "${text}")
# Each parameter is a control port behind JUCE's own, and no property beside it: hosts would list both, as two values.
string(REGEX REPLACE "plug:[a-z_]+\n\ta lv2:Parameter ;\n(\t[^\n]*\n)+\n" "" text "${text}")
string(REGEX REPLACE "\tpatch:(writable|readable)(( ,)?\n\t\tplug:[a-z_]+)+ ;\n" "" text "${text}")
if(NOT text MATCHES "lv2:symbol \"level\"")
    if(NOT text MATCHES "lv2:symbol \"enabled\"[^]]*lv2:index ([0-9]+)")
        message(FATAL_ERROR "${FOLDER}/dsp.ttl: expected a port \"enabled\", to put the parameters' ports behind it: found none")
    endif()
    math(EXPR first "${CMAKE_MATCH_1} + 1")
    # LV2 numbers without a major version, releases are even, and 0 is none: 20 for 1.0.
    string(REGEX MATCH "lv2:minorVersion ([0-9]+)" minor "${text}")
    math(EXPR even "20 + 2 * ${CMAKE_MATCH_1}")
    string(REPLACE "${minor} ;" "lv2:minorVersion ${even} ;" text "${text}")
    execute_process(COMMAND ${PORTS} ${first} OUTPUT_VARIABLE ports COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE "\t] ;\n\topts:supportedOption" "\t] , [\n${ports}\t] ;\n\topts:supportedOption" text "${text}")
endif()
file(WRITE "${FOLDER}/dsp.ttl" "${text}")

# The window's: a feature that is named as data, and data that are named as a feature.
file(READ "${FOLDER}/ui.ttl" text)
string(REPLACE "\t\tui:noUserResize ,\n" "" text "${text}")
string(REPLACE "lv2:optionalFeature\n\t\tui:resize ,\n\t\topts:interface ,\n" "lv2:optionalFeature\n\t\tui:resize ,\n" text "${text}")
file(WRITE "${FOLDER}/ui.ttl" "${text}")

# What presets set is a property with a name.
file(READ "${FOLDER}/manifest.ttl" text)
if(NOT text MATCHES ":Program>\n" AND text MATCHES "(<[^>]*:Program>)")
    string(APPEND text "\n${CMAKE_MATCH_1}\n\ta <http://www.w3.org/1999/02/22-rdf-syntax-ns#Property> ;\n\trdfs:label \"Program\" .\n")
    file(WRITE "${FOLDER}/manifest.ttl" "${text}")
endif()
