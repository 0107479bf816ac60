// Options of the sanitizers, linked into the tests and the program under test.

/// Libraries stay loaded to the end, so that those that leak can be named: MPI would unload its
/// plugins before.
extern "C" int dlclose(void*) {
  return 0;
}

extern "C" const char* __ubsan_default_options() {
  return "print_stacktrace=1";
}

extern "C" const char* __lsan_default_options() {
  return "print_suppressions=0";
}

/// Open MPI keeps the tables of its configuration and plugins to the end of the process, among them
/// texts from asprintf, whose caller is not on record; nothing of Rollwave calls asprintf.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libmpi.so\n"
         "leak:libopen-pal.so\n"
         "leak:libopen-rte.so\n"
         "leak:libhwloc.so\n"
         "leak:libpmix.so\n"
         "leak:mca_\n"
         "leak:__vasprintf_internal\n";
}
