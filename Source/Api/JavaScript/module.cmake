# SPDX-License-Identifier: MIT
# Generates what the modules of the package and of the web page share: include/physvib/Version.h, include/Members.inc, package/profiles.js, and
# ${exports}, the header's functions.
get_filename_component(physvib_root ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)

file(STRINGS ${physvib_root}/VERSION.txt PHYSVIB_VERSION)
string(REGEX REPLACE "-.*" "" numbers ${PHYSVIB_VERSION})
string(REPLACE "." ";" numbers ${numbers})
list(GET numbers 0 PROJECT_VERSION_MAJOR)
list(GET numbers 1 PROJECT_VERSION_MINOR)
list(GET numbers 2 PROJECT_VERSION_PATCH)
configure_file(${physvib_root}/Source/Package/Version.h.in include/physvib/Version.h @ONLY)
# JavaScript calls all functions of the header except those of files, which a page lacks, of materials, for which it has materials.js, and of pads (Pads.cpp);
# it reads all members of its structures.
set(header ${physvib_root}/Source/Api/C/physvib.h)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
file(READ ${header} text)
string(REGEX REPLACE "[][;]" "|" text "${text}") # these characters have a meaning in CMake lists
string(REPLACE "\n" ";" lines "${text}")
set(members "")
set(exports "")
foreach(line IN LISTS lines)
    if(NOT line MATCHES "physvib_motors" AND line MATCHES "^typedef struct (physvib_[a-z_]+) {")
        set(structure ${CMAKE_MATCH_1})
    elseif(structure AND line MATCHES "^    (size_t|int|double|physvib_int64|physvib_layout|const physvib_renderer_settings[*]) ([a-z_0-9]+)[|]")
        string(APPEND members "MEMBER(${structure}, ${CMAKE_MATCH_2})\n")
    elseif(line MATCHES "^}" AND structure)
        string(APPEND members "END(${structure})\n")
        unset(structure)
    elseif(NOT line MATCHES "_(load|save|parse)(_field)?\\(|physvib_(material|material_name|sound|event_of|renderer_impact|renderer_impact_of)\\(|physvib_pads_" AND line MATCHES "^PHYSVIB_API .*(physvib_[a-z_]+)\\(")
        list(APPEND exports -Wl,--export=${CMAKE_MATCH_1})
    endif()
endforeach()
file(CONFIGURE OUTPUT include/Members.inc CONTENT "${members}" @ONLY)

# Profiles of game controllers, as a JavaScript module: their numbers.
file(GLOB pads CONFIGURE_DEPENDS ${physvib_root}/Source/Scene/Pads/*.json)
set(text "")
foreach(pad ${pads})
    get_filename_component(name ${pad} NAME_WE)
    file(READ ${pad} profile)
    string(REGEX REPLACE "\n  \"(physvib_pad|name|description|source)\":[^\n]*" "" profile "${profile}")
    string(APPEND text "    '${name}': ${profile},\n")
endforeach()
file(CONFIGURE OUTPUT package/profiles.js CONTENT "// SPDX-License-Identifier: MIT\n// What motors of controllers do: Docs/pads.md.\nexport const profiles = {\n${text}};\n" @ONLY)

# Materials of the built-in tables, likewise.
file(GLOB tables CONFIGURE_DEPENDS ${physvib_root}/Source/Scene/Materials/*.json)
set(text "")
foreach(table ${tables})
    file(READ ${table} materials)
    string(REGEX REPLACE "\n  \"(physvib_materials|source)\":[^\n]*" "" materials "${materials}")
    string(APPEND text "${materials},\n")
endforeach()
file(CONFIGURE OUTPUT package/materials.js CONTENT "// SPDX-License-Identifier: MIT\n// The built-in tables of materials: Docs/materials.md.\nexport const tables = [\n${text}];\n" @ONLY)
