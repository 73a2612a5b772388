#include "python/errors.h"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "python/interpreter_lock.h"

namespace sandstroke {
namespace {

namespace py = pybind11;

thread_local std::vector<std::string>* collecting = nullptr;

class WarningSink : public spdlog::sinks::base_sink<std::mutex> {
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::string text(message.payload.data(), message.payload.size());
    if (collecting)
      collecting->push_back(text);
    else
      fmt::print(stderr, "sandstroke: {}\n", text);
  }
  void flush_() override {}
};

/// Removes "--set " and "--unset " from a sentence: Python has no command line.
std::string without_option(std::string sentence) {
  for (const std::string_view option : {"--set ", "--unset "})
    for (std::size_t at; (at = sentence.find(option)) != std::string::npos;)
      sentence.erase(at, option.size());
  return sentence;
}

py::handle new_error(py::module_& module, const char* name, py::handle base, py::handle also,
                     const char* text) {
  const std::string full = std::string("sandstroke.") + name;
  const py::tuple bases = also ? py::tuple(py::make_tuple(base, also)) : py::tuple(py::make_tuple(base));
  py::handle error = PyErr_NewExceptionWithDoc(full.c_str(), text, bases.ptr(), nullptr);
  module.add_object(name, error);
  return error;
}

py::handle input_error, unstable_error, file_error, result_warning;

/// The warning as Python has it: with its code, if it makes a result doubtful.
py::object python_warning(const std::string& sentence, const std::vector<Warning>& coded) {
  for (const Warning& warning : coded)
    if (warning.line() == sentence) {
      py::object made = result_warning(without_option(warning.text));
      made.attr("code") = warning.kind().word;
      made.attr("section") = warning.kind().section;
      return made;
    }
  return py::reinterpret_borrow<py::object>(PyExc_UserWarning)(without_option(sentence));
}

}  // namespace

void add_errors(py::module_& module) {
  const py::handle error = new_error(module, "Error", PyExc_Exception, {},
                                     "Base of all errors of sandstroke. The message is one sentence.");
  input_error = new_error(module, "InputError", error, PyExc_ValueError,
                          "An argument, a setting or a file's content is wrong.");
  unstable_error = new_error(module, "UnstableError", error, PyExc_ArithmeticError,
                             "The run is unstable, or a law makes or loses sand; try other settings.");
  file_error = new_error(module, "FileError", error, PyExc_OSError, "A file could not be read or written.");
  result_warning =
      new_error(module, "ResultWarning", PyExc_UserWarning, {},
                "A result is doubtful. code: a word of `sandstroke help warnings`; section: of the "
                "scene.");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& failure) {
      const py::handle type = failure.kind() == ErrorKind::input      ? input_error
                              : failure.kind() == ErrorKind::unstable ? unstable_error
                                                                      : file_error;
      PyErr_SetString(type.ptr(), without_option(failure.what()).c_str());
    }
  });
  auto logger = std::make_shared<spdlog::logger>("sandstroke", std::make_shared<WarningSink>());
  logger->set_level(spdlog::level::warn);
  spdlog::set_default_logger(logger);
}

thread_local std::exception_ptr kept_exception;

void throw_raised(const py::error_already_set& raised) {
  if (raised.matches(PyExc_KeyboardInterrupt) || raised.matches(PyExc_SystemExit))
    kept_exception = std::make_exception_ptr(raised);
  const std::string text = raised.what();
  throw std::runtime_error(text.substr(0, text.find('\n')));
}

void throw_kept() {
  if (kept_exception) std::rethrow_exception(std::exchange(kept_exception, nullptr));
  throw;
}

Warnings::Warnings() : before_(collecting) { collecting = &sentences_; }
Warnings::~Warnings() { collecting = before_; }

void Warnings::give() {
  constexpr int caller = 2;  // the stack level of the code that called the package
  for (const std::string& sentence : sentences_)
    py::module_::import("warnings")
        .attr("warn")(python_warning(sentence, coded_.warnings()), py::arg("stacklevel") = caller);
  sentences_.clear();
}

void SignalWatch::look() {
  stay_if_leaving();
  constexpr double interval = 0.05;  // s
  using Seconds = std::chrono::duration<double>;
  const double now = Seconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  if (now < next_) return;
  next_ = now + interval;
  const WithLock lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace sandstroke
