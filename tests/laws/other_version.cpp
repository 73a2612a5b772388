// As if it had been built for a sandstroke of another version.
extern "C" const char* sandstroke_plugin_interface() { return "sandstroke 9.9.9, laws 7"; }
