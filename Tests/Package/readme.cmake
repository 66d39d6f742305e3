# SPDX-License-Identifier: MIT
# README shows the example as it is compiled, without the line of its licence.
file(READ ${ROOT}/README.md readme)
file(READ ${ROOT}/Tests/Example/main.cpp example)
string(FIND "${example}" "\n" end)
string(SUBSTRING "${example}" ${end} -1 example)
string(FIND "${readme}" "```cpp${example}```" place)
if(place EQUAL -1)
    message(FATAL_ERROR "README.md: expected a block with all of Tests/Example/main.cpp after its first line")
endif()
