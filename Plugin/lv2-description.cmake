# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DFILE=dsp.ttl -P lv2-description.cmake: what JUCE's generator of LV2 descriptions gets wrong, put right; and the option
# that our entry reads. Once done it finds nothing more to do.
file(READ "${FILE}" text)
# Numbers of parameters are floats; without a point they are read as whole numbers, of another type than the range says.
string(REGEX REPLACE "((lv2:default|lv2:minimum|lv2:maximum|rdf:value) -?[0-9]+)([ \t\n])" "\\1.0\\3" text "${text}")
# Neither is known; an empty address is that of the file.
string(REGEX REPLACE "\t\tfoaf:(homepage|mbox) <> ;\n" "" text "${text}")
string(REPLACE "\t\tbufs:maxBlockLength .\n" "\t\tbufs:maxBlockLength , bufs:nominalBlockLength .\n" text "${text}")
# Ports are called as the enchanters that they drive: A, B, ...
foreach(number RANGE 1 26)
    math(EXPR letter "64 + ${number}")
    string(ASCII ${letter} label)
    string(REPLACE "lv2:name \"Audio Out ${number}\"" "lv2:name \"${label}\"" text "${text}")
endforeach()
file(WRITE "${FILE}" "${text}")
