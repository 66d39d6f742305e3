# SPDX-License-Identifier: MIT
# What comes with PhysVib is whatever stands in these folders: first what people know by its place in a list, then the others by name.
set(physvib_first_Scene/Scenes shake-the-box fruit-basket driving drop box-study marbles drawing)
set(physvib_first_Scene/Materials table-5-1)
set(physvib_first_Scene/Actuators lra-205 piezo-230 haptuator-mark-2 haptuator-2 haptuator-planar erm-coin voice-coil)
set(physvib_first_Scene/Pads pad-generic pad-xbox pad-dualshock)
set(physvib_first_Lab/Protocols patterns phantom-grids phantom-places model-or-sound eight-methods level-steps level-quest magnitudes)

# physvib_built_in(OUT FOLDER), as Scene/Scenes: its files, in the order of their listing.
function(physvib_built_in out folder)
    set(from ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${folder})
    if(CMAKE_SCRIPT_MODE_FILE)
        file(GLOB others ${from}/*.json ${from}/*.R ${from}/*.qmd ${from}/*.svg)
    else()
        file(GLOB others CONFIGURE_DEPENDS ${from}/*.json ${from}/*.R ${from}/*.qmd ${from}/*.svg)
    endif()
    list(FILTER others EXCLUDE REGEX "\\.schema\\.json$")
    set(files ${physvib_first_${folder}})
    list(TRANSFORM files REPLACE "(.+)" "${from}/\\1.json")
    list(APPEND files ${others})
    list(REMOVE_DUPLICATES files)
    set(${out} ${files} PARENT_SCOPE)
endfunction()

# physvib_embed(FOLDER): embeddedNAME.cpp, by which its files become part of a library.
function(physvib_embed folder)
    physvib_built_in(files ${folder})
    list(JOIN files "," listed)
    get_filename_component(name ${folder} NAME)
    set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/Io/embed.cmake)
    add_custom_command(OUTPUT embedded${name}.cpp
        COMMAND ${CMAKE_COMMAND} -DOUT=embedded${name}.cpp -DFILES=${listed} -DNAME=embedded${name} -P ${script}
        DEPENDS ${script} ${files} VERBATIM)
endfunction()
