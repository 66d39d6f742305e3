# SPDX-License-Identifier: MIT
# What a page says to save and to paste, as files: ```c drop.c is drop.c, ```sh is `commands`, ```sh once is `once`.
/^```/ { name = (name == "" && NF == 2) ? $2 : (name == "" && $1 == "```sh") ? "commands" : ""; next }
name != "" { print > name }
