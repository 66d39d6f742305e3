# SPDX-License-Identifier: MIT
# Installed are the promised headers (Docs/Doxyfile) and what they include, no more than so many. Where there are more, the message names
# those that nobody was promised, and who includes them.
# Usage: cmake -DROOT=. -DINSTALLED=<an installed copy> -P few-headers.cmake
set(most 65) # vectors, inertia, parts with their panners, and cells in space came to the first 60
set(include ${INSTALLED}/include/physvib)
file(GLOB_RECURSE headers RELATIVE ${include} ${include}/*.h)
list(LENGTH headers count)
if(count EQUAL 0)
    message(FATAL_ERROR "no headers in ${include}")
elseif(count GREATER most)
    file(READ ${ROOT}/Docs/Doxyfile promised)
    foreach(header ${headers})
        string(FIND "${promised}" "/${header}" at)
        if(NOT at EQUAL -1 OR header MATCHES "^engines/|^Version[.]h$")
            continue()
        endif()
        set(by "")
        foreach(other ${headers})
            file(STRINGS ${include}/${other} found REGEX "^ *# *include +<physvib/${header}>")
            if(found)
                string(APPEND by " ${other}")
            endif()
        endforeach()
        list(APPEND unpromised "${header}, included by${by}")
    endforeach()
    list(JOIN unpromised "\n" lines)
    message(FATAL_ERROR "${count} headers are installed, at most ${most} expected. Promised to nobody are:\n${lines}")
endif()
