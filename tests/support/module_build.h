/**
 * module_build.h - shared libraries for tests of code that is exchanged: compiled here and now, with the flags of this build.
 */
#pragma once

/**
 * Compiles a source into FOLDER/NAME.so, by way of another file, as ./nook watch does. Fails the test when the compiler does.
 * @param source   from the root of the repository, "tests/module/counter_library.c"
 * @param options  more of them, "-DCOUNTER_STEP=2"; "" for none
 */
void module_build(const char *folder, const char *name, const char *source, const char *options);
/** Puts a library that was built elsewhere into the folder. */
void module_put(const char *folder, const char *name, const char *path);
/** Says that the folder holds a new build. @param text  after its number: "ok", "failed\nfile.c:1: wrong" */
void module_publish(const char *folder, const char *text);
/** Files in a folder whose name holds `part`. */
int module_count_files(const char *folder, const char *part);
