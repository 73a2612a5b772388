#include "browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;
constexpr int limit_ms = 600'000;  // of any answer: only ever met when something hangs

void require(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error("browser: " + what);
}

/// A pipe, its ends above the numbers that the browser is to have.
std::array<int, 2> make_pipe() {
  int ends[2];
  require(pipe2(ends, O_CLOEXEC) == 0, "no pipe");
  std::array<int, 2> moved;
  for (std::size_t i = 0; i < 2; ++i) {
    moved[i] = fcntl(ends[i], F_DUPFD_CLOEXEC, 10);
    close(ends[i]);
  }
  return moved;
}

/// A string as JavaScript writes it.
std::string quoted(const std::string& text) { return Json(text).dump(); }

struct Key {
  std::string key, code;
  int number;  // Windows' virtual key code, which is what KeyboardEvent.keyCode says
  std::string text;
};

Key key_of(const std::string& name) {
  static const std::map<std::string, Key> named = {
      {"Tab", {"Tab", "Tab", 9, ""}},
      {"Enter", {"Enter", "Enter", 13, "\r"}},
      {"Escape", {"Escape", "Escape", 27, ""}},
      {"Space", {" ", "Space", 32, " "}},
      {" ", {" ", "Space", 32, " "}},
      {"Backspace", {"Backspace", "Backspace", 8, ""}},
      {"Delete", {"Delete", "Delete", 46, ""}},
      {"PageUp", {"PageUp", "PageUp", 33, ""}},
      {"PageDown", {"PageDown", "PageDown", 34, ""}},
      {"End", {"End", "End", 35, ""}},
      {"Home", {"Home", "Home", 36, ""}},
      {"ArrowLeft", {"ArrowLeft", "ArrowLeft", 37, ""}},
      {"ArrowUp", {"ArrowUp", "ArrowUp", 38, ""}},
      {"ArrowRight", {"ArrowRight", "ArrowRight", 39, ""}},
      {"ArrowDown", {"ArrowDown", "ArrowDown", 40, ""}},
  };
  if (const auto found = named.find(name); found != named.end()) return found->second;
  require(name.size() == 1, "unknown key " + name);
  const auto character = static_cast<unsigned char>(name[0]);
  const char upper = static_cast<char>(std::toupper(character));
  const bool letter = std::isalpha(character), digit = std::isdigit(character);
  return {name,
          letter  ? std::string("Key") + upper
          : digit ? "Digit" + name
                  : "",
          letter || digit ? upper : 0, name};
}

}  // namespace

Browser::Browser() {
  const auto [in_read, in_write] = make_pipe();
  const auto [out_read, out_write] = make_pipe();
  const std::string at = folder_.path().string();
  const std::string command = "exec " + chromium_command +
                              " --remote-debugging-pipe --window-size=1200,900 --user-data-dir='" + at +
                              "/profile' about:blank 2> '" + at + "/log'";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in_read, 3);  // where the browser reads commands
  posix_spawn_file_actions_adddup2(&actions, out_write, 4);
  posix_spawnattr_t attributes;  // a process group of its own: all its processes can be ended
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const char* const arguments[] = {"sh", "-c", command.c_str(), nullptr};
  const int failed =
      posix_spawn(&process_, "/bin/sh", &actions, &attributes, const_cast<char**>(arguments), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(in_read);
  close(out_write);
  to_browser_ = in_write;
  from_browser_ = out_read;
  require(!failed, "could not be started");
}

Browser::~Browser() {
  // It ends with its pipes, and normally at once.
  close(to_browser_);
  close(from_browser_);
  const auto ended = [&] { return waitpid(process_, nullptr, WNOHANG) != 0; };
  for (int i = 0; i < 500; ++i) {
    if (ended()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(-process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

Json Browser::next_message() {
  for (std::size_t end; (end = read_.find('\0')) == std::string::npos;) {
    pollfd wait{from_browser_, POLLIN, 0};
    require(poll(&wait, 1, limit_ms) > 0, "no answer for ten minutes");
    char part[65536];
    const ssize_t count = read(from_browser_, part, sizeof part);
    if (count <= 0) {
      std::ostringstream log;
      log << std::ifstream(folder_ / "log").rdbuf();
      require(false, "ended: " + log.str());
    }
    read_.append(part, static_cast<std::size_t>(count));
  }
  const std::size_t end = read_.find('\0');
  const Json message = Json::parse(read_.begin(), read_.begin() + static_cast<std::ptrdiff_t>(end));
  read_.erase(0, end + 1);
  return message;
}

void Browser::note_event(const Json& event) {
  if (event.value("sessionId", "") != session_) return;
  const std::string method = event.value("method", "");
  const Json& of = event["params"];
  if (method == "Page.loadEventFired") loaded_ = true;
  if (method == "Runtime.exceptionThrown")
    errors_.push_back(of["exceptionDetails"].value("/exception/description"_json_pointer,
                                                   of["exceptionDetails"].value("text", "")));
  if (method == "Runtime.consoleAPICalled" && (of["type"] == "error" || of["type"] == "assert")) {
    std::string text;
    for (const Json& value : of["args"])
      text.append(value.value("description", value.value("value", Json()).dump())).append(" ");
    errors_.push_back(text);
  }
  if (method == "Log.entryAdded" && of["entry"]["level"] == "error") errors_.push_back(of["entry"]["text"]);
}

Json Browser::call(const std::string& method, const Json& parameters) {
  Json request = {{"id", ++last_id_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) request["sessionId"] = session_;
  const std::string text = request.dump();
  const char* rest = text.c_str();
  for (std::size_t left = text.size() + 1; left > 0;) {  // with the NUL that ends it
    const ssize_t count = write(to_browser_, rest, left);
    require(count > 0, "does not listen");
    rest += count;
    left -= static_cast<std::size_t>(count);
  }
  for (;;) {
    const Json message = next_message();
    if (message.value("id", 0) != last_id_) {
      note_event(message);
      continue;
    }
    require(!message.contains("error"), method + ": " + message.value("error", Json()).dump());
    return message["result"];
  }
}

void Browser::open(const std::filesystem::path& file) {
  open_address("file://" + std::filesystem::absolute(file).lexically_normal().string());
}

void Browser::open_address(const std::string& address) {
  session_.clear();
  if (!target_.empty()) {
    call("Target.closeTarget", {{"targetId", target_}});
    call("Target.disposeBrowserContext", {{"browserContextId", context_}});
  }
  errors_.clear();
  loaded_ = false;
  context_ = call("Target.createBrowserContext")["browserContextId"];
  target_ = call("Target.createTarget", {{"url", "about:blank"}, {"browserContextId", context_}})["targetId"];
  session_ = call("Target.attachToTarget", {{"targetId", target_}, {"flatten", true}})["sessionId"];
  for (const char* domain : {"Page", "Runtime", "Log"}) call(domain + std::string(".enable"));
  call("Emulation.setFocusEmulationEnabled", {{"enabled", true}});
  const Json opened = call("Page.navigate", {{"url", address}});
  require(!opened.contains("errorText"), address + ": " + opened.value("errorText", ""));
  while (!loaded_) note_event(next_message());
  wait_for("document.documentElement.dataset.ready === 'true'");
}

void Browser::open_text(const std::string& page) {
  std::ofstream(folder_ / "page.html") << page;
  open(folder_ / "page.html");
}

void Browser::resize(int width, int height) {
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

void Browser::prefer(const std::string& scheme) {
  const Json feature = {{"name", "prefers-color-scheme"}, {"value", scheme}};
  call("Emulation.setEmulatedMedia", {{"features", Json::array({feature})}});
}

std::string Browser::screenshot() {
  const std::string text = call("Page.captureScreenshot", {{"format", "png"}})["data"];
  std::string bytes;
  std::uint32_t bits = 0;
  int known = 0;
  for (const char c : text) {  // base64, RFC 4648
    const char* const alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char* const at = std::strchr(alphabet, c);
    if (c == '=' || !at) break;
    bits = bits << 6 | static_cast<std::uint32_t>(at - alphabet);
    if ((known += 6) >= 8) bytes += static_cast<char>(bits >> (known -= 8) & 255u);
  }
  return bytes;
}

Json Browser::evaluate(const std::string& expression) {
  const Json answer = call(
      "Runtime.evaluate",
      {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}, {"userGesture", false}});
  if (answer.contains("exceptionDetails")) {
    const Json& details = answer["exceptionDetails"];
    require(false, "\"" + expression + "\" threw: " +
                       details.value("/exception/description"_json_pointer, details.value("text", "")));
  }
  return answer["result"].value("value", Json());
}

void Browser::wait_for(const std::string& condition) {
  const Json held = evaluate("new Promise((done, fail) => { let turns = 0; const look = () => { try { if (" +
                             condition + ") done(true); else if (++turns < 60000) setTimeout(look, 10); " +
                             "else done(false); } catch (error) { fail(error); } }; look(); })");
  require(held == true, "waited in vain for " + condition);
}

Point Browser::centre(const std::string& selector) {
  const Json found = evaluate("(() => { const one = document.querySelector(" + quoted(selector) + R"js();
    if (!one) return "is not in the page";
    one.scrollIntoView({ block: "center", inline: "center", behavior: "instant" });
    const box = one.getBoundingClientRect();
    const x = box.x + box.width / 2, y = box.y + box.height / 2;
    const met = document.elementFromPoint(x, y);
    if (!met || !(one.contains(met) || met.contains(one)))
      return `is not in sight: at its middle is ${met?.outerHTML.slice(0, 200)}`;
    return { x, y }; })())js");
  require(found.is_object(), selector + " " + (found.is_string() ? found.get<std::string>() : ""));
  return {found["x"], found["y"]};
}

void Browser::mouse(const char* type, Point at, int buttons) {
  const bool presses = type != std::string("mouseMoved");
  call("Input.dispatchMouseEvent", {{"type", type},
                                    {"x", at.x},
                                    {"y", at.y},
                                    {"button", presses || buttons ? "left" : "none"},
                                    {"buttons", buttons},
                                    {"clickCount", presses ? 1 : 0}});
}

void Browser::hover(Point at) { mouse("mouseMoved", at, 0); }

void Browser::click(Point at) { drag(at, at); }

void Browser::drag(Point from, Point to, int steps, double rate) {
  const auto pause = [rate] {
    if (rate > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(1.0 / rate));
  };
  mouse("mouseMoved", from, 0);
  pause();
  mouse("mousePressed", from, 1);
  for (int step = 1; step <= steps && (to.x != from.x || to.y != from.y); ++step) {
    pause();
    mouse("mouseMoved", {from.x + (to.x - from.x) * step / steps, from.y + (to.y - from.y) * step / steps},
          1);
  }
  pause();
  mouse("mouseReleased", to, 0);
}

void Browser::press(const std::string& key) {
  const std::size_t plus = key.size() > 1 ? key.find('+') : std::string::npos;
  const std::string held = plus == std::string::npos ? "" : key.substr(0, plus);
  require(held.empty() || held == "Shift" || held == "Control", "unknown key " + key);
  const Key one = key_of(held.empty() ? key : key.substr(plus + 1));
  Json event = {{"type", "keyDown"},
                {"key", one.key},
                {"code", one.code},
                {"windowsVirtualKeyCode", one.number},
                {"modifiers", held == "Shift"     ? 8
                              : held == "Control" ? 2
                                                  : 0}};
  if (!one.text.empty() && held != "Control") event["text"] = one.text;
  static const std::map<std::string, std::string> editing = {
      {"a", "selectAll"}, {"c", "copy"}, {"v", "paste"}};
  if (const auto found = editing.find(one.key); held == "Control" && found != editing.end())
    event["commands"] = {found->second};  // which a desktop would give these keys
  call("Input.dispatchKeyEvent", event);
  event["type"] = "keyUp";
  event.erase("text");
  call("Input.dispatchKeyEvent", event);
}

void Browser::type(const std::string& text) {
  for (const char character : text) press(std::string(1, character));
}

void Browser::choose(const std::string& selector, const std::string& text) {
  const std::string one = "document.querySelector(" + quoted(selector) + ")";
  const Json place = evaluate(
      one + ".focus(), [..." + one +
      ".options].filter(({ disabled }) => !disabled).findIndex((option) => option.text === " + quoted(text) +
      ")");
  require(place >= 0, selector + " has no option \"" + text + "\"");
  press("Home");
  for (int i = 0; i < place; ++i) press("ArrowDown");
  require(evaluate(one + ".selectedOptions[0].text") == text, selector + " did not take \"" + text + "\"");
}

}  // namespace sandstroke
