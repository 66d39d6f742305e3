# SPDX-License-Identifier: MIT
# Turns text files into a C++ source: cmake -DOUT=FILE.cpp -DFILES=A.json,B.json -DNAME=embeddedScenes -P embed.cmake
# A string literal longer than some compilers bear is written in pieces, which the compiler joins.
string(REPLACE "," ";" files "${FILES}")
set(text "// Made by Source/Io/embed.cmake.\n#include \"Io/Disk/Embedded.h\"\n\nnamespace physvib {\n")
string(APPEND text "\nconst std::vector<EmbeddedFile>& ${NAME}() {\n    static const std::vector<EmbeddedFile> files{\n")
foreach(file ${files})
    get_filename_component(name ${file} NAME)
    file(READ ${file} content)
    if(COMPACT) # JSON without the spaces between its words: a page is loaded
        string(REGEX REPLACE "(\":|[],}],|{) " "\\1" content "${content}")
        string(REGEX REPLACE "([]}0-9\"]) }" "\\1}" content "${content}")
        string(REGEX REPLACE "([0-9]), " "\\1," content "${content}") # in numbers; a title has none
        string(REGEX REPLACE "\n *" ")json\"\n        R\"json(" content "${content}")
    else()
        string(REPLACE "\n" ")json\"\n        R\"json(\n" content "${content}")
    endif()
    string(APPEND text "        {\"${name}\",\n        R\"json(${content})json\"},\n")
endforeach()
string(APPEND text "    };\n    return files;\n}\n\n} // namespace physvib\n")
file(WRITE ${OUT} "${text}")
