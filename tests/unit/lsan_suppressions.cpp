// What LeakSanitizer is not to report.

// Where an outline is refused, GLU is left by longjmp and keeps what it had: its interface has no
// other way out.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(readability-identifier-naming)
extern "C" const char* __lsan_default_suppressions() { // NOLINT(readability-identifier-naming)
    return "leak:libGLU";
}
