# SPDX-License-Identifier: MIT
# Headers that many read, and that had grown too long to read: what comes later grows into parts of its own.
set(longest 120)
set(headers Source/Host/Devices/AudioOutput.h)
foreach(header ${headers})
    file(READ ${ROOT}/${header} text)
    string(REGEX MATCHALL "\n" lines "${text}")
    list(LENGTH lines count)
    if(count GREATER longest)
        message(SEND_ERROR "${header}: ${count} lines; expected at most ${longest}")
    endif()
endforeach()
