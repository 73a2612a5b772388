#include "view/view_client.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstring>
#include <stdexcept>

namespace sandstroke {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

tcp::socket connected(asio::io_context& io, int port) {
  tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), static_cast<unsigned short>(port)});
  return socket;
}

template <class Number>
Number get(const char*& at) {
  Number number;
  std::memcpy(&number, at, sizeof number);
  at += sizeof number;
  return number;
}

SeenPicture decoded(const std::string& message) {
  const char* at = message.data();
  if (message.size() < 80 || get<std::uint32_t>(at) != 0x444e4153) throw std::runtime_error("no picture");
  const auto count = get<std::uint32_t>(at);
  SeenPicture picture;
  picture.time = get<double>(at);
  for (float& axis : picture.tip) axis = get<float>(at);
  for (float& axis : picture.force) axis = get<float>(at);
  for (float* number : {&picture.depth, &picture.rate, &picture.lateness, &picture.max_lateness})
    *number = get<float>(at);
  picture.flags = get<std::uint32_t>(at);
  at += 20;  // how the tool is turned, and nothing
  if (message.size() != 80 + count * (4 + 4 * 4096)) throw std::runtime_error("a picture of a wrong size");
  for (std::uint32_t i = 0; i < count; ++i) {
    std::vector<float>& tile = picture.tiles[get<std::uint32_t>(at)];
    tile.resize(4096);
    for (float& height : tile) height = get<float>(at);
  }
  return picture;
}

}  // namespace

HttpAnswer http_get(int port, const std::string& target, const std::map<std::string, std::string>& fields,
                    const std::string& method) {
  asio::io_context io;
  tcp::socket socket = connected(io, port);
  http::request<http::empty_body> request;
  request.method_string(method);
  request.target(target);
  request.set(http::field::host, "127.0.0.1:" + std::to_string(port));
  for (const auto& [name, value] : fields) request.set(name, value);
  beast::error_code failure;
  http::write(socket, request, failure);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  http::read(socket, buffer, response, failure);
  if (failure) return {};
  HttpAnswer answer{static_cast<int>(response.result_int()), {}, response.body()};
  for (const auto& field : response)
    answer.fields[std::string(field.name_string())] = std::string(field.value());
  return answer;
}

int port_of(const std::string& address) { return std::stoi(address.substr(address.find(':', 7) + 1)); }
std::string token_of_address(const std::string& address) { return address.substr(address.find('=') + 1); }

struct ViewClient::Socket {
  asio::io_context io;
  websocket::stream<tcp::socket> stream{io};
};

ViewClient::ViewClient(const std::string& address, const std::map<std::string, std::string>& fields)
    : socket_(std::make_unique<Socket>()) {
  const int port = port_of(address);
  socket_->stream.next_layer() = connected(socket_->io, port);
  socket_->stream.read_message_max(std::size_t{1} << 24);
  socket_->stream.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
    for (const auto& [name, value] : fields) request.set(name, value);
  }));
  socket_->stream.handshake("127.0.0.1:" + std::to_string(port), "/live?token=" + token_of_address(address));
}

ViewClient::~ViewClient() = default;

bool ViewClient::hear() {
  beast::flat_buffer buffer;
  beast::error_code failure;
  socket_->stream.read(buffer, failure);
  if (failure) {
    close_code = socket_->stream.reason().code;
    return false;
  }
  const std::string message = beast::buffers_to_string(buffer.data());
  if (socket_->stream.got_text()) {
    const nlohmann::json text = nlohmann::json::parse(message);
    said[text.items().begin().key()] = text.items().begin().value();
    return true;
  }
  picture = decoded(message);
  ++pictures;
  tiles_taken += static_cast<std::int64_t>(picture->tiles.size());
  for (const auto& [index, heights] : picture->tiles) tiles[index] = heights;
  return true;
}

void ViewClient::send(std::string_view bytes, bool text) {
  socket_->stream.text(text);
  beast::error_code failure;
  socket_->stream.write(asio::buffer(bytes.data(), bytes.size()), failure);
}

void ViewClient::point(double time, float x, float y, float pressure, std::uint32_t switches) {
  std::string message;
  const auto put = [&message](auto number) {
    message.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  put(time);
  put(x);
  put(y);
  put(pressure);
  put(switches);
  send(message);
}

void ViewClient::vanish() { socket_->stream.next_layer().close(); }

float ViewClient::height(int row, int col) const {
  const int tile_cols = (cols() + 63) / 64;
  return tiles.at(static_cast<std::uint32_t>(row / 64 * tile_cols + col / 64))
      .at(static_cast<std::size_t>(row % 64 * 64 + col % 64));
}

SilentConnection::SilentConnection(int port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("no connection");
}

SilentConnection::SilentConnection(SilentConnection&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)) {}

SilentConnection::~SilentConnection() {
  if (socket_ >= 0) close(socket_);
}

void SilentConnection::send(std::string_view bytes) {
  if (::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) return;
}

std::string SilentConnection::hear_to_end() {
  std::string heard;
  char bytes[4096];
  for (ssize_t count; (count = recv(socket_, bytes, sizeof bytes, 0)) > 0;)
    heard.append(bytes, static_cast<std::size_t>(count));
  return heard;
}

}  // namespace sandstroke
