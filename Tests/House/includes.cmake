# SPDX-License-Identifier: MIT
# Each room includes only what the rule in CMakeLists.txt allows it; header-only rooms would slip past the linker.
set(Core_may "Core/")
set(Wire_may "Wire/|Core/")
set(Io_may "Io/|Core/|nlohmann/")
set(Contacts_may "Contacts/|Core/")
set(Physics_may "Physics/|Contacts/|Core/|box2d/")
set(Scene_may "Scene/|Physics/|Contacts/|Io/|Core/|box2d/|nlohmann/")
set(Stimuli_may "Stimuli/|Core/")
set(Lab_may "Lab/|Stimuli/|Scene/|Io/|Core/|Eigen/|nlohmann/")
set(Formats_may "Formats/|Io/|Core/|nlohmann/")
set(Measure_may "Measure/|Eigen/|unsupported/Eigen/|Io/(Result|Text/NumberText)\\.h|Contacts/(Grains|Texture)\\.h|Core/") # one line of words for what a recording lacks
set(Api_may "Api/C/|Scene/|Io/|Contacts/|Core/")
set(Api/Live_may "Api/|Live/|Scene/|Io/|Contacts/|Core/")
set(Api/Godot_may "Api/Godot/") # and the public headers
set(Api/JavaScript_may "Api/(C|JavaScript)/|Members\\.inc|Formats/|Scene/|Io/|Core/")
set(Live/Sockets_may "Live/Sockets/|Io/")
set(Live/Documents_may "Live/Documents/|Scene/|Io/|Core/|nlohmann/")
set(Live/Session_may "Live/(Documents|Messages|Session)/|Stimuli/|Scene/|Io/|Physics/|Contacts/|Wire/|Core/")
set(Live/Messages_may "${Live/Session_may}")
set(Live/Pads_may "Live/|SDL2/|Scene/|Io/|Core/")
set(Live/Devices_may "Live/|Stimuli/|Scene/|Io/|Core/|jack/|alsa/")
set(Live/Recordings_may "Live/|Wire/|Stimuli/|Formats/|Measure/HitExcerpt\\.h|Scene/|Io/|Core/|sndfile\\.h")
set(Live/Rig_may "Live/|Core/")
set(Standalone/Web_may "Api/JavaScript/Exports\\.h|Formats/|Measure/|box2d/|Scene/|Io/|Physics/|Contacts/|Core/")
set(Standalone/Render_may "Pictures/|Live/Session/OfflineRender\\.h|Scene/|Io/|Physics/|Contacts/|Core/")
set(Standalone/Options_may "Options/|Scene/|Io/")
set(Pictures_may "Pictures/|Scene/|Io/|Core/|ft2build|png\\.h")
set(Host_may "Host/|Live/|Pictures/(Palette|ShapeOutline|WaveformEnvelope)\\.h|aubio/|Scene/|Io/|Physics/|Contacts/|Core/|juce_")
set(Host/Osc_may "Host/Osc/|Live/|Scene/|Io/|Physics/|Core/|lo/")
set(Plugin_may "Host/|Live/|Scene/|Io/|Physics/|Contacts/|Stimuli/|Core/|juce_|[A-Za-z0-9]+\\.h\"") # its own files have no folder
# The mixer, from below: the model, which plays without studies and windows; widgets that all panels share; panels that do not see each other;
# the window with all of them.
set(Mixer_may "Host/|Live/|Pictures/|Stimuli/|Scene/|Io/|Core/|juce_")
set(Standalone/Mixer/Model_may "Mixer/Model/|${Mixer_may}")
set(Standalone/Mixer/Widgets_may "Mixer/(Model|Widgets)/|Measure/|Lab/Files/Translation\\.h|${Mixer_may}")
foreach(panel World Strips Output Materials Studies)
    set(Standalone/Mixer/${panel}_may "Mixer/(Model|Widgets|${panel})/|Measure/|Formats/|Contacts/|Lab/|Studies/|${Mixer_may}")
endforeach()
# Core also stays free of what a board without an operating system lacks.
set(Core_never "<(iostream|string|vector|map|memory|thread|mutex|functional|stdexcept|fstream|chrono)>")

set(bad "")
foreach(room Core Wire Io Contacts Physics Scene Stimuli Formats Measure Pictures Lab Api Api/Godot Api/JavaScript Api/Live Live/Documents Live/Sockets Live/Messages Live/Session Live/Pads Live/Devices Live/Recordings Live/Rig Host Host/Osc Plugin
             Standalone/Mixer/Model Standalone/Mixer/Widgets Standalone/Mixer/World Standalone/Mixer/Strips Standalone/Mixer/Output
             Standalone/Mixer/Materials Standalone/Mixer/Studies Standalone/Options Standalone/Render Standalone/Web)
    file(GLOB_RECURSE files ${ROOT}/Source/${room}/*.h ${ROOT}/Source/${room}/*.cpp ${ROOT}/${room}/*.h ${ROOT}/${room}/*.cpp)
    if(room STREQUAL "Api") # Live: a room of its own, under another licence; JavaScript: with Formats; Engines: headers for engines of the user
        list(FILTER files EXCLUDE REGEX "/Api/(Godot|Live|JavaScript|Engines)/")
    elseif(room STREQUAL "Host") # so is this, and without JUCE
        list(FILTER files EXCLUDE REGEX "/Host/Osc/")
    endif()
    foreach(file ${files})
        file(STRINGS ${file} includes REGEX "^ *# *include")
        foreach(line ${includes})
            if(line MATCHES "include *\"" AND NOT line MATCHES "\"(${${room}_may})")
                list(APPEND bad "${file}: ${line}")
            elseif(line MATCHES "<(aubio/|lo/|SDL2/|jack/|alsa/|sndfile\\.h|box2d|juce_|nlohmann|Eigen/|unsupported/|boost/|ft2build|png\\.h)" AND NOT line MATCHES "<(${${room}_may})")
                list(APPEND bad "${file}: ${line}")
            elseif(room STREQUAL "Core" AND line MATCHES "${Core_never}")
                list(APPEND bad "${file}: ${line}")
            endif()
        endforeach()
    endforeach()
endforeach()
# refuse(PATTERN WHY FILE...): no line of these files matches.
function(refuse pattern why)
    foreach(file ${ARGN})
        file(STRINGS ${file} lines REGEX "${pattern}")
        foreach(line ${lines})
            list(APPEND bad "${file}: ${line}: ${why}")
        endforeach()
    endforeach()
    set(bad "${bad}" PARENT_SCOPE)
endfunction()

# One file per program knows the parser; all others fill its table.
file(GLOB_RECURSE files ${ROOT}/Standalone/*.h ${ROOT}/Standalone/*.cpp)
list(FILTER files EXCLUDE REGEX "/Standalone/(Options/Parser\\.cpp|Render/Main\\.cpp)$")
refuse("^ *# *include *<CLI/" "only in Options/Parser.cpp, see OptionTable.h" ${files})
# A window makes jobs as a call does, and needs no command: what both need is beside them.
file(GLOB_RECURSE files ${ROOT}/Standalone/*.h ${ROOT}/Standalone/*.cpp)
list(FILTER files EXCLUDE REGEX "/Standalone/CommandLine/")
refuse("^ *# *include *\"CommandLine/" "not from the command line" ${files})
# What asks the system for more than C++ knows is in files that are named for it, one per system and matter.
set(systems "<(unistd|fcntl|poll|spawn|termios|pthread|dirent|dlfcn|sched|signal|netdb|pwd|strings|syslog|windows|winsock2|ws2tcpip|io|process)\\.h>|<(sys|netinet|arpa|net|linux|mach)/")
set(calls "[^A-Za-z_.>:](getpid|gethostname|isatty|fileno|mkdtemp|mkstemp|fork|waitpid|kill|usleep|nanosleep|popen|readlink|realpath|localtime_r|gmtime_r|clock_gettime|setenv)\\(|[^A-Za-z_](ssize_t|pid_t|SIGHUP|SIGPIPE)[^A-Za-z_]")
file(GLOB_RECURSE files ${ROOT}/Source/*.h ${ROOT}/Source/*.cpp ${ROOT}/Plugin/*.h ${ROOT}/Plugin/*.cpp ${ROOT}/Standalone/*.h ${ROOT}/Standalone/*.cpp)
list(FILTER files EXCLUDE REGEX "(Posix|Windows)\\.(h|cpp)$")
refuse("^ *# *include *(${systems})|${calls}" "only in a file ...Posix or ...Windows" ${files})
# What samples and events depend on has the same bits everywhere; what is drawn, measured and counted need not.
file(GLOB_RECURSE files ${ROOT}/Source/Core/*.h ${ROOT}/Source/Core/*.cpp ${ROOT}/Source/Contacts/* ${ROOT}/Source/Physics/* ${ROOT}/Source/Scene/*.h ${ROOT}/Source/Scene/*.cpp
                        ${ROOT}/Source/Stimuli/* ${ROOT}/Source/Formats/* ${ROOT}/Source/Live/*.h ${ROOT}/Source/Live/*.cpp)
refuse("std::(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|polar|arg)\\(" "Core/PortableMath.h has it" ${files})
if(bad)
    list(JOIN bad "\n" lines)
    message(FATAL_ERROR "includes that leave their room:\n${lines}")
endif()
