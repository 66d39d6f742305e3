# SPDX-License-Identifier: MIT
# Copies what the board is made of from ROOT to TO and replaces OLD in FILE by NEW: a planted fault.
file(COPY ${ROOT}/Firmware/Image ${ROOT}/Firmware/toolchain.cmake DESTINATION ${TO}/Firmware)
file(COPY ${ROOT}/Source/Core ${ROOT}/Source/Wire DESTINATION ${TO}/Source)
if(FILE)
    file(READ ${ROOT}/${FILE} text)
    string(REPLACE "${OLD}" "${NEW}" mutant "${text}")
    if(mutant STREQUAL text)
        message(FATAL_ERROR "${FILE} does not hold \"${OLD}\": the mutant would be none")
    endif()
    file(WRITE ${TO}/${FILE} "${mutant}")
endif()
