# SPDX-License-Identifier: MIT
# Our headers as other people include them: "Core/..." becomes <physvib/Core/...>, which meets nobody else's Core.
# Usage: cmake -DFROM=Source -DTO=include/physvib "-DROOMS=Core;..." -P headers.cmake
cmake_policy(VERSION 3.22)
list(JOIN ROOMS "|" names)
set(wanted "")
foreach(room ${ROOMS})
    file(GLOB_RECURSE headers RELATIVE ${FROM} ${FROM}/${room}/*.h)
    list(FILTER headers EXCLUDE REGEX "Json") # they serve our own files alone; without them nobody else needs nlohmann-json
    foreach(header ${headers})
        file(READ ${FROM}/${header} text)
        string(REGEX REPLACE "(\n *# *include +)\"((${names})/[^\"]*)\"" "\\1<physvib/\\2>" text "${text}")
        file(CONFIGURE OUTPUT ${TO}/${header} CONTENT "${text}" @ONLY) # what has not changed keeps its time
        list(APPEND wanted ${header})
    endforeach()
endforeach()
file(GLOB_RECURSE there RELATIVE ${TO} ${TO}/*/*.h)
list(FILTER there EXCLUDE REGEX "^engines/") # they have no room's name, and are copied as they are
foreach(header ${there})
    if(NOT header IN_LIST wanted) # one of ours that has gone
        file(REMOVE ${TO}/${header})
    endif()
endforeach()
