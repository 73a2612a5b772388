#include "view/view_server.h"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <thread>
#include <vector>

#include "core/error.h"
#include "view/admission.h"

namespace sandstroke {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;
using Seconds = std::chrono::duration<double>;

constexpr std::chrono::milliseconds accept_pause{100};
constexpr std::size_t most_request_bytes = 8192;
constexpr int most_unsent_bytes = 256 * 1024;  // in the system: what waits there is old when it is seen

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(Seconds(seconds));
}

/// Counts one object while it lives.
class Counted {
 public:
  explicit Counted(std::atomic<int>& count) : count_(count) { ++count_; }
  ~Counted() { --count_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  std::atomic<int>& count_;
};

class Page;

/// Data that pages share. Only the server's thread uses it, but for the counts.
struct Shared {
  Shared(ViewSources shown, const ViewLimits& set, int port)
      : sources(std::move(shown)), limits(set), admission(port), hello(hello_message(sources.hello)) {}

  ViewSources sources;
  ViewLimits limits;
  Admission admission;
  std::string hello;
  std::atomic<int> connections = 0, page_count = 0;
  std::vector<std::shared_ptr<Page>> pages;
  const Page* hand = nullptr;  // the page whose pointer is the hand
  bool ended = false;
  std::string end;  // the message
};

/// A page that watches, and perhaps draws.
class Page : public std::enable_shared_from_this<Page> {
 public:
  Page(tcp::socket socket, Shared& shared)
      : stream_(std::move(socket)),
        shared_(shared),
        connection_(shared.connections),
        page_(shared.page_count) {}

  void start(const http::request<http::empty_body>& request) {
    websocket::stream_base::timeout limits{};
    limits.handshake_timeout = milliseconds(shared_.limits.silence);
    limits.idle_timeout = milliseconds(shared_.limits.page_silence);
    limits.keep_alive_pings = true;
    stream_.set_option(limits);
    stream_.read_message_max(most_message_bytes);
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = shared_from_this()](error_code failure) {
      if (failure) return;
      self->shared_.pages.push_back(self);
      self->read();
      self->send_texts();
    });
  }

  /// Sends a picture; called when it is time for one.
  void send_picture() {
    if (writing_ || closing_ || !said_hello_) return;
    if (fill_picture()) write(picture_, Message::binary);
  }
  /// Sends texts that may have changed. Only the newest are sent, not those in between.
  void send_texts() {
    if (writing_ || closing_) return;
    if (!said_hello_) {
      said_hello_ = true;
      return write(shared_.hello, Message::text);
    }
    const std::string status = shared_.sources.state.status();
    if (status != said_status_) {
      said_status_ = status;
      return write(text_ = status_message(status), Message::text);
    }
    if (const bool drawing = shared_.hand == this; shared_.hand && drawing != said_drawing_) {
      said_drawing_ = drawing;
      return write(text_ = drawing_message(drawing), Message::text);
    }
    if (!shared_.hand && said_drawing_) said_drawing_.reset();
    if (!shared_.ended) return;
    if (fill_picture()) return write(picture_, Message::binary);
    closing_ = true;
    write(shared_.end, Message::text);
  }
  /// Forgets a page that is closed or must be closed: nothing is sent to it any more.
  void gone() {
    if (std::erase(shared_.pages, shared_from_this()) == 0) return;
    beast::get_lowest_layer(stream_).close();
    if (shared_.hand != this) return;
    shared_.hand = nullptr;
    shared_.sources.pointer->leave();
  }

 private:
  bool fill_picture() {
    ViewState state;
    const bool newer = shared_.sources.state.take_newer(state_version_, state);
    shared_.sources.bed.take_newer(reader_, tiles_);
    if (!newer && tiles_.index.empty()) return false;
    put_picture(state, tiles_, state.load != said_load_, picture_);
    said_load_ = state.load;
    return true;
  }

  enum class Message { text, binary };
  void write(const std::string& message, Message kind) {
    writing_ = true;
    stream_.text(kind == Message::text);
    stream_.async_write(asio::buffer(message), [self = shared_from_this()](error_code failure, std::size_t) {
      self->writing_ = false;
      if (failure) return self->gone();
      if (self->closing_) return self->close();
      self->send_texts();
    });
  }

  void read() {
    stream_.async_read(heard_, [self = shared_from_this()](error_code failure, std::size_t) {
      if (failure || !self->hear()) return self->gone();
      self->heard_.consume(self->heard_.size());
      self->read();
    });
  }

  /// False: the message breaks the contract.
  bool hear() {
    if (stream_.got_text() || !shared_.sources.pointer) return false;
    const auto bytes = heard_.cdata();
    const std::optional<std::vector<PointerSample>> samples =
        pointer_samples({static_cast<const char*>(bytes.data()), bytes.size()});
    if (!samples) return false;
    if (!shared_.hand && draws(*samples)) {
      shared_.hand = this;
      for (const std::shared_ptr<Page>& page : shared_.pages) page->send_texts();
    }
    if (shared_.hand == this) shared_.sources.pointer->take(*samples);
    return true;
  }
  static bool draws(const std::vector<PointerSample>& samples) {
    return std::any_of(samples.begin(), samples.end(), [](const auto& sample) {
      return sample.pressure > 0 || (sample.switches >> PointerSample::finish_switch & 1U) != 0;
    });
  }

  void close() {
    stream_.async_close(websocket::close_code::normal,
                        [self = shared_from_this()](error_code) { self->gone(); });
  }

  websocket::stream<beast::tcp_stream> stream_;
  Shared& shared_;
  Counted connection_, page_;
  beast::flat_buffer heard_{most_message_bytes};
  LiveBed::Reader reader_;
  LiveBed::Tiles tiles_;
  std::string picture_, text_;  // being sent
  std::uint64_t state_version_ = 0;
  bool writing_ = false, closing_ = false, said_hello_ = false;
  std::shared_ptr<const TriangleMesh> said_load_;
  std::string said_status_;
  std::optional<bool> said_drawing_;
};

/// A connection up to its one request.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Shared& shared)
      : stream_(std::move(socket)), shared_(shared), connection_(shared.connections) {
    parser_.header_limit(most_request_bytes);
    parser_.body_limit(0);
  }

  void start() {
    stream_.expires_after(milliseconds(shared_.limits.silence));
    http::async_read(stream_, buffer_, parser_, [self = shared_from_this()](error_code failure, std::size_t) {
      if (!failure) self->serve();
    });
  }

 private:
  using Text = std::string_view;
  using Request = http::request<http::empty_body>;

  static Text text_of(boost::beast::string_view text) { return {text.data(), text.size()}; }
  static std::optional<Text> field(const Request& request, http::field name) {
    const auto found = request.find(name);
    return found == request.end() ? std::nullopt : std::optional(text_of(found->value()));
  }

  void serve() {
    const Request& request = parser_.get();
    const ViewRequest asked{text_of(request.method_string()), text_of(request.target()),
                            field(request, http::field::host), field(request, http::field::origin)};
    if (const std::optional<Refusal> refusal = shared_.admission.refuses(asked))
      return answer(refusal->status, "text/plain; charset=utf-8", refusal->sentence);
    if (path_of(asked.target) == "/") return answer(200, "text/html; charset=utf-8", shared_.sources.page);
    if (!websocket::is_upgrade(request))
      return answer(426, "text/plain; charset=utf-8", "Only the page itself may use this address.\n");
    if (shared_.ended || shared_.page_count >= shared_.limits.pages)
      return answer(503, "text/plain; charset=utf-8",
                    "The view has ended, or too many pages are open: close one.\n");
    stream_.expires_never();  // the page has its own limits
    std::make_shared<Page>(stream_.release_socket(), shared_)->start(request);
  }

  void answer(int status, const char* type, const std::string& body) {
    stream_.expires_after(milliseconds(shared_.limits.page_silence));
    response_.result(static_cast<unsigned>(status));
    response_.set(http::field::content_type, type);
    response_.set(http::field::cache_control, "no-store");
    response_.set(http::field::connection, "close");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    const int port = static_cast<int>(stream_.socket().local_endpoint().port());
    response_.set("Content-Security-Policy",
                  fmt::format("default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
                              "img-src data:; connect-src ws://127.0.0.1:{} ws://localhost:{}; "
                              "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
                              port, port));
    response_.body() = body;
    response_.keep_alive(false);
    response_.prepare_payload();
    http::async_write(stream_, response_, [self = shared_from_this()](error_code, std::size_t) {
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  beast::tcp_stream stream_;
  Shared& shared_;
  Counted connection_;
  beast::flat_buffer buffer_{2 * most_request_bytes};
  http::request_parser<http::empty_body> parser_;
  http::response<http::string_body> response_;
};

}  // namespace

class ViewServer::Implementation {
 public:
  Implementation(ViewSources sources, const ViewLimits& limits)
      : acceptor_(listening(io_)), pictures_(io_), pause_(io_), port_(acceptor_.local_endpoint().port()) {
    shared_ = std::make_unique<Shared>(std::move(sources), limits, port_);
    accept();
    send_pictures();
    thread_ = std::thread([this] { run(); });
  }
  ~Implementation() { end("the program ended"); }

  void end(const std::string& reason) {
    if (!thread_.joinable()) return;
    asio::post(io_, [this, reason] {
      shared_->ended = true;
      shared_->end = end_message(reason);
      acceptor_.close();
      pause_.expires_after(milliseconds(shared_->limits.end));
      pause_.async_wait([this](error_code) { io_.stop(); });
      for (const std::shared_ptr<Page>& page : shared_->pages) page->send_texts();
    });
    thread_.join();
    for (const std::shared_ptr<Page>& page : std::vector(shared_->pages)) page->gone();
  }

  int port() const { return port_; }
  std::string address() const {
    return fmt::format("http://127.0.0.1:{}/?token={}", port_, shared_->admission.token());
  }
  int pages() const { return shared_->page_count; }

 private:
  static tcp::acceptor listening(asio::io_context& io) {
    try {
      tcp::acceptor acceptor(io, tcp::endpoint(asio::ip::address_v4::loopback(), 0));
      fcntl(acceptor.native_handle(), F_SETFD, FD_CLOEXEC);  // not for the browser that this program opens
      return acceptor;
    } catch (const boost::system::system_error& failure) {
      throw_io_error("--view: cannot open a port on 127.0.0.1: {}; leave out --view",
                     failure.code().message());
    }
  }

  /// An error of one page (no memory for it, say) ends that page, not the others.
  void run() {
    while (!io_.stopped()) {
      try {
        io_.run();
      } catch (const std::exception& failure) {
        spdlog::warn("an error ended a page of the view: {}", failure.what());
      }
    }
  }

  void accept() {
    acceptor_.async_accept([this](error_code failure, tcp::socket socket) {
      if (shared_->ended) return;
      if (failure) {  // no descriptors are left, say
        pause_.expires_after(accept_pause);
        pause_.async_wait([this](error_code) {
          if (!shared_->ended) accept();
        });
        return;
      }
      accept();
      if (shared_->connections < shared_->limits.connections)
        serve(std::move(socket));
      else
        refuse(socket);
    });
  }

  void serve(tcp::socket socket) {
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    socket.set_option(asio::socket_base::send_buffer_size(most_unsent_bytes), ignored);
    fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
    std::make_shared<Connection>(std::move(socket), *shared_)->start();
  }

  static void refuse(tcp::socket& socket) {
    constexpr std::string_view answer =
        "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Length: 22\r\n\r\nToo many "
        "connections.\n";
    error_code ignored;
    socket.non_blocking(true, ignored);
    socket.write_some(asio::buffer(answer), ignored);
  }

  void send_pictures() {
    pictures_.expires_after(std::chrono::duration_cast<std::chrono::nanoseconds>(Seconds(picture_interval)));
    pictures_.async_wait([this](error_code) {
      if (shared_->ended && shared_->pages.empty()) return io_.stop();
      send_pictures();
      for (const std::shared_ptr<Page>& page : std::vector(shared_->pages)) {
        page->send_texts();
        page->send_picture();
      }
    });
  }

  std::unique_ptr<Shared> shared_;  // outlives what io_ still holds
  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer pictures_, pause_;
  int port_;
  std::thread thread_;
};

ViewServer::ViewServer(ViewSources sources, const ViewLimits& limits)
    : implementation_(std::make_unique<Implementation>(std::move(sources), limits)) {}
ViewServer::~ViewServer() = default;

int ViewServer::port() const { return implementation_->port(); }
std::string ViewServer::address() const { return implementation_->address(); }
int ViewServer::pages() const { return implementation_->pages(); }
void ViewServer::end(const std::string& reason) { implementation_->end(reason); }

}  // namespace sandstroke
