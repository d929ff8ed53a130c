// Built into tests under AddressSanitizer: libraries stay loaded to the end, so that leaks of
// theirs are reported under their names, which tests/lsan.supp lists.
extern "C" int dlclose(void*) {
    return 0;
}
