# SPDX-License-Identifier: MIT
# Each room includes only what Docs/architecture.md allows it; header-only rooms would slip past the linker.
set(Core_may "Core/")
set(Wire_may "Wire/|Core/")
set(Study_may "Study/|Core/|Eigen/|boost/")
set(Contacts_may "Contacts/|Core/")
set(Physics_may "Physics/|Contacts/|Core/|box2d/")
set(Files_may "Files/|Physics/|Contacts/|Study/|Core/|nlohmann/")
set(Formats_may "Formats/|Files/(Result|SampledSound)\\.h|Files/(Disk|Json|Text)/|Core/|nlohmann/") # reads and writes as Files does
set(Measure_may "Measure/|Eigen/|unsupported/Eigen/|Files/(Result|Text/NumberText)\\.h|Contacts/(Grains|Texture)\\.h|Core/") # one line of words for what a recording lacks
set(Api_may "Api/C/|Files/|Contacts/|Core/")
set(Api/Live_may "Api/|Host/|Session/|Files/|Core/|juce_")
set(Session_may "Session/|Files/|Physics/|Contacts/|Wire/|Study/|Core/")
set(Standalone/Web_may "PageWorld\\.h|Files/|Physics/|Contacts/|Core/")
set(Standalone/Render_may "InRange\\.h|Session/OfflineRender\\.h|Files/|Physics/|Contacts/|Core/")
set(Host_may "Host/|aubio/|Formats/|Session/|Measure/|Files/|Physics/|Contacts/|Wire/|Study/|Core/|juce_")
set(Host/Osc_may "Host/Osc/|Session/|Files/|Physics/|Core/|lo/")
set(Plugin_may "Host/|Session/|Files/|Physics/|Contacts/|Wire/|Study/|Core/|juce_|[A-Za-z0-9]+\\.h\"") # its own files have no folder
# Core also stays free of what a board without an operating system lacks.
set(Core_never "<(iostream|string|vector|map|memory|thread|mutex|functional|stdexcept|fstream|chrono)>")

set(bad "")
foreach(room Core Wire Study Contacts Physics Files Formats Measure Api Api/Live Session Host Host/Osc Plugin Standalone/Render Standalone/Web)
    file(GLOB_RECURSE files ${ROOT}/Source/${room}/*.h ${ROOT}/Source/${room}/*.cpp ${ROOT}/${room}/*.h ${ROOT}/${room}/*.cpp)
    if(room STREQUAL "Api") # a room of its own, under another licence
        list(FILTER files EXCLUDE REGEX "/Api/Live/")
    elseif(room STREQUAL "Host") # so is this, and without JUCE
        list(FILTER files EXCLUDE REGEX "/Host/Osc/")
    endif()
    foreach(file ${files})
        file(STRINGS ${file} includes REGEX "^ *# *include")
        foreach(line ${includes})
            if(line MATCHES "include *\"" AND NOT line MATCHES "\"(${${room}_may})")
                list(APPEND bad "${file}: ${line}")
            elseif(line MATCHES "<(aubio/|lo/|box2d|juce_|nlohmann|Eigen/|unsupported/|boost/)" AND NOT line MATCHES "<(${${room}_may})")
                list(APPEND bad "${file}: ${line}")
            elseif(room STREQUAL "Core" AND line MATCHES "${Core_never}")
                list(APPEND bad "${file}: ${line}")
            endif()
        endforeach()
    endforeach()
endforeach()
if(bad)
    list(JOIN bad "\n" lines)
    message(FATAL_ERROR "includes that leave their room:\n${lines}")
endif()
