# SPDX-License-Identifier: MIT
# How a project with PhysVib as a folder of it is compiled: nothing of ours is in the user's commands, our own files keep our
# rounding, and nothing is built but the library.
# Usage: cmake -DBUILD=<its build folder> -P leaks.cmake
file(READ ${BUILD}/compile_commands.json commands)
string(JSON count LENGTH ${commands})
math(EXPR last "${count} - 1")
set(bad "")
foreach(i RANGE ${last})
    string(JSON file GET ${commands} ${i} file)
    string(JSON command GET ${commands} ${i} command)
    if(file MATCHES "/Source/[A-Z][a-z]+/.*\\.cpp$")
        if(file MATCHES "/Source/(Live|Host|Lab)/" OR NOT command MATCHES "-ffp-contract=off" OR command MATCHES "-Werror")
            string(APPEND bad "\n${command}")
        endif()
    elseif(NOT file MATCHES "/(main|module|every-header|embedded[A-Z][a-z]+)\\.cpp$" OR command MATCHES "/Source( |$)")
        string(APPEND bad "\n${command}")
    elseif(NOT file MATCHES "embedded" AND command MATCHES "-ffp-contract|-fno-")
        string(APPEND bad "\n${command}")
    endif()
endforeach()
if(bad)
    message(FATAL_ERROR "not expected in a user's build:${bad}")
endif()
