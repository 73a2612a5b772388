// A plugin that says it was built for another version of sandstroke.
extern "C" const char* sandstroke_plugin_interface() { return "sandstroke 9.9.9, laws 7"; }
