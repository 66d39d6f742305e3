# SPDX-License-Identifier: MIT
# What comes with PhysVib is whatever stands in these folders: first what people know by its place in a list, then the others by name.
set(physvib_first_Scenes shake-the-box fruit-basket driving drop box-study marbles drawing)
set(physvib_first_Actuators lra-205 piezo-230 haptuator-mark-2 haptuator-2 haptuator-planar erm-coin voice-coil)
set(physvib_first_Protocols patterns phantom-grids phantom-places model-or-sound eight-methods level-steps level-quest magnitudes)

# physvib_built_in(OUT FOLDER): its files, in the order of their listing.
function(physvib_built_in out folder)
    set(from ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${folder})
    if(CMAKE_SCRIPT_MODE_FILE)
        file(GLOB others ${from}/*.json)
    else()
        file(GLOB others CONFIGURE_DEPENDS ${from}/*.json)
    endif()
    list(FILTER others EXCLUDE REGEX "\\.schema\\.json$")
    set(files ${physvib_first_${folder}})
    list(TRANSFORM files REPLACE "(.+)" "${from}/\\1.json")
    list(APPEND files ${others})
    list(REMOVE_DUPLICATES files)
    set(${out} ${files} PARENT_SCOPE)
endfunction()
