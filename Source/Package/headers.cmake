# SPDX-License-Identifier: MIT
# Our headers as other people include them: "Core/..." becomes <physvib/Core/...>, which meets nobody else's Core. Those that are
# promised (Docs/stable.md, the reference's list) and what they include; all others are ours alone.
# Usage: cmake -DFROM=Source -DTO=include/physvib -P headers.cmake
cmake_policy(VERSION 3.22)
file(STRINGS ${FROM}/../Docs/Doxyfile lines REGEX "Source/[A-Za-z/]+\\.h")
string(REGEX MATCHALL "Source/(Core|Contacts|Physics)/[A-Za-z0-9/]+\\.h" wanted "${lines}")
list(TRANSFORM wanted REPLACE "^Source/" "")
set(at 0)
list(LENGTH wanted count)
while(at LESS count)
    list(GET wanted ${at} header)
    file(READ ${FROM}/${header} text)
    string(REGEX MATCHALL "\n *# *include +\"[^\"]+\"" includes "${text}")
    list(TRANSFORM includes REPLACE "^.*\"([^\"]+)\"$" "\\1")
    list(APPEND wanted ${includes})
    list(REMOVE_DUPLICATES wanted)
    list(LENGTH wanted count)
    string(REGEX REPLACE "(\n *# *include +)\"([^\"]+)\"" "\\1<physvib/\\2>" text "${text}")
    file(CONFIGURE OUTPUT ${TO}/${header} CONTENT "${text}" @ONLY) # what has not changed keeps its time
    math(EXPR at "${at} + 1")
endwhile()
list(TRANSFORM wanted REPLACE "(.+)" "#include <physvib/\\1>\n" OUTPUT_VARIABLE every)
list(JOIN every "" every)
file(CONFIGURE OUTPUT ${TO}/../every-header.cpp CONTENT "${every}") # of which a test makes one file
file(GLOB_RECURSE there RELATIVE ${TO} ${TO}/*/*.h)
list(FILTER there EXCLUDE REGEX "^engines/") # they have no room's name, and are copied as they are
foreach(header ${there})
    if(NOT header IN_LIST wanted) # one of ours that has gone
        file(REMOVE ${TO}/${header})
    endif()
endforeach()
