// A library that knows nothing of sandstroke.
extern "C" int answer() { return 42; }
