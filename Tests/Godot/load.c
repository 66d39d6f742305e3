/* SPDX-License-Identifier: MIT */
/* Loads an addon's library as Godot does, and calls its entry: with a Godot that has no function, and with
 * one that has them all. No header of Godot is needed: a pointer has the size of a pointer, and the entry
 * sets two of three. Usage: load LIBRARY */
#include <stdio.h>
#include <string.h>

static int asked;
static void nothing(void) {}
static void (*none(const char* name))(void) { return asked += name != NULL, (void (*)(void))NULL; }
static void (*all(const char* name))(void) { return name != NULL ? nothing : none(name); }

typedef void (*(*Get)(const char*))(void);
typedef struct {
    int level;
    void *userdata, *start, *stop;
} Initialization;
typedef unsigned char (*Entry)(Get, void*, Initialization*);

#ifdef _WIN32
#include <windows.h>
static void* entryOf(const char* path) {
    HMODULE library = LoadLibraryExA(path, NULL, LOAD_WITH_ALTERED_SEARCH_PATH);
    if (library == NULL) printf("error %lu\n", GetLastError());
    return library == NULL ? NULL : (void*)GetProcAddress(library, "physvib_godot_init");
}
#else
#include <dlfcn.h>
static void* entryOf(const char* path) {
    void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) printf("%s\n", dlerror());
    return library == NULL ? NULL : dlsym(library, "physvib_godot_init");
}
#endif

int main(int count, char** words) {
    void* found = count == 2 ? entryOf(words[1]) : NULL;
    Entry entry;
    Initialization made = {0, NULL, NULL, NULL};
    memcpy(&entry, &found, sizeof entry);
    if (found == NULL) return printf("WRONG: there is no entry\n"), 1;
    if (entry(none, NULL, &made) != 0)
        return printf("WRONG: expected it to decline a Godot without functions\n"), 1;
    if (asked < 30 || entry(all, NULL, &made) != 1 || made.start == NULL || made.stop == NULL)
        return printf("WRONG: expected it to take a Godot with all functions\n"), 1;
    return printf("right: the entry asks for %d functions of Godot, declines one without them, and takes one "
                  "with them\n",
                  asked),
           0;
}
