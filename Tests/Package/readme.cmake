# SPDX-License-Identifier: MIT
# README shows the short example as it is compiled, without the line of its licence.
file(READ ${ROOT}/README.md readme)
file(READ ${ROOT}/Tests/Example/impacts.cpp example)
string(FIND "${example}" "\n" end)
math(EXPR begin "${end} + 1")
string(SUBSTRING "${example}" ${begin} -1 example)
string(FIND "${readme}" "```cpp\n${example}```" place)
if(place EQUAL -1)
    message(FATAL_ERROR "README.md: expected a block with all of Tests/Example/impacts.cpp after its first line")
endif()
