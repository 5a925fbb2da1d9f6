// How nghttp2 and a connection meet: what nghttp2 calls.
#include <algorithm>

#include "gateway/http2/connection.h"
#include "gateway/http2/headers.h"

namespace contact::gateway {
namespace {

// Bytes of data at which a write begins. Without a bound one call of nghttp2 goes on for as long as
// any stream has something to send.
constexpr std::size_t kOut = 128 << 10;
constexpr std::size_t kMostData = 64 << 10;
// nghttp2 ends a connection that takes back more calls. They cost little here, and honest clients
// take back hundreds a second.
constexpr std::uint64_t kResets = 10'000;
constexpr std::uint64_t kResetsPerSecond = 2000;
// Answers to PING and SETTINGS that wait for a client that reads nothing.
constexpr std::size_t kWaitingAnswers = 100;

std::string_view View(const std::uint8_t* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace

struct Http2Callbacks {
  static Http2Connection& Of(void* user) { return *static_cast<Http2Connection*>(user); }

  // Null once the stream is over.
  static Http2Connection::StreamPtr Find(Http2Connection& connection, std::int32_t id) {
    const auto found = connection.streams_.find(id);
    return found == connection.streams_.end() ? nullptr : found->second;
  }

  static int OnBeginFrame(nghttp2_session* /*session*/, const nghttp2_frame_hd* /*head*/,
                          void* user) {
    Of(user).frames_.Add();
    return 0;
  }

  static int OnBeginHeaders(nghttp2_session* /*session*/, const nghttp2_frame* frame, void* user) {
    if (frame->hd.type != NGHTTP2_HEADERS || frame->headers.cat != NGHTTP2_HCAT_REQUEST) return 0;
    Http2Connection& connection = Of(user);
    const std::int32_t id = frame->hd.stream_id;
    connection.streams_[id] = std::make_shared<Http2Stream>(connection.shared_from_this(), id);
    return 0;
  }

  static int OnHeader(nghttp2_session* /*session*/, const nghttp2_frame* frame,
                      const std::uint8_t* name, std::size_t name_size, const std::uint8_t* value,
                      std::size_t value_size, std::uint8_t /*flags*/, void* user) {
    if (frame->headers.cat != NGHTTP2_HCAT_REQUEST) return 0;
    const auto stream = Find(Of(user), frame->hd.stream_id);
    if (!stream || stream->AddHeader(View(name, name_size), View(value, value_size))) return 0;
    return NGHTTP2_ERR_CALLBACK_FAILURE;  // A temporal failure would go on decoding.
  }

  static int OnFrame(nghttp2_session* /*session*/, const nghttp2_frame* frame, void* user) {
    if (frame->hd.type != NGHTTP2_HEADERS && frame->hd.type != NGHTTP2_DATA) return 0;
    Http2Connection& connection = Of(user);
    const auto stream = Find(connection, frame->hd.stream_id);
    if (!stream) return 0;
    const bool head =
        frame->hd.type == NGHTTP2_HEADERS && frame->headers.cat == NGHTTP2_HCAT_REQUEST;
    const bool ended = (frame->hd.flags & NGHTTP2_FLAG_END_STREAM) != 0;
    const bool early = head && stream->EndHead();
    if (ended) stream->EndRequest();
    if (early || ended) connection.Ready(stream);
    return 0;
  }

  static int OnData(nghttp2_session* session, std::uint8_t /*flags*/, std::int32_t id,
                    const std::uint8_t* data, std::size_t size, void* user) {
    Http2Connection& connection = Of(user);
    // Streams must not block one another: what is held is counted instead.
    nghttp2_session_consume_connection(session, size);
    connection.frames_.Moved(size);
    const auto stream = Find(connection, id);
    if (!stream) return 0;
    const std::size_t opened = stream->AddBody(View(data, size));
    if (opened > 0) nghttp2_session_consume_stream(session, id, opened);
    if (stream->refusal()) connection.Ready(stream);
    return 0;
  }

  static int OnClose(nghttp2_session* /*session*/, std::int32_t id, std::uint32_t /*code*/,
                     void* user) {
    Http2Connection& connection = Of(user);
    const auto stream = Find(connection, id);
    if (!stream) return 0;
    connection.streams_.erase(id);
    if (stream->begun()) --connection.begun_;
    if (connection.streams_.empty()) connection.idle_ = std::chrono::steady_clock::now();
    stream->Close();
    return 0;
  }

  static int OnSent(nghttp2_session* session, const nghttp2_frame* frame, void* user) {
    const bool ends = (frame->hd.flags & NGHTTP2_FLAG_END_STREAM) != 0;
    const bool answers = frame->hd.type == NGHTTP2_HEADERS || frame->hd.type == NGHTTP2_DATA;
    if (!ends || !answers) return 0;
    Of(user).frames_.Answered();
    // The answer is whole, and the request need not be.
    if (nghttp2_session_get_stream_remote_close(session, frame->hd.stream_id) == 0) {
      nghttp2_submit_rst_stream(session, NGHTTP2_FLAG_NONE, frame->hd.stream_id, NGHTTP2_NO_ERROR);
    }
    return 0;
  }

  static ssize_t OnPull(nghttp2_session* session, std::int32_t id, std::uint8_t* /*buffer*/,
                        std::size_t most, std::uint32_t* flags, nghttp2_data_source* /*source*/,
                        void* user) {
    const auto stream = Find(Of(user), id);
    if (!stream) return NGHTTP2_ERR_TEMPORAL_CALLBACK_FAILURE;
    const std::size_t bytes = stream->Offer(most);
    const bool ends = stream->Ends(bytes);
    if (bytes == 0 && !ends) return NGHTTP2_ERR_DEFERRED;
    *flags |= NGHTTP2_DATA_FLAG_NO_COPY;
    if (!ends) return static_cast<ssize_t>(bytes);
    *flags |= NGHTTP2_DATA_FLAG_EOF;
    if (!stream->trailers().empty()) {
      *flags |= NGHTTP2_DATA_FLAG_NO_END_STREAM;
      const auto trailers = ToNv(stream->trailers());
      nghttp2_submit_trailer(session, id, trailers.data(), trailers.size());
    }
    return static_cast<ssize_t>(bytes);
  }

  static int OnSendData(nghttp2_session* /*session*/, nghttp2_frame* frame,
                        const std::uint8_t* head, std::size_t size, nghttp2_data_source* /*source*/,
                        void* user) {
    constexpr std::size_t kHead = 9;
    Http2Connection& connection = Of(user);
    std::string& out = connection.thread_.out;
    if (out.size() >= kOut) return NGHTTP2_ERR_WOULDBLOCK;
    const auto stream = Find(connection, frame->hd.stream_id);
    if (!stream) return NGHTTP2_ERR_TEMPORAL_CALLBACK_FAILURE;
    out.append(View(head, kHead));
    stream->Move(size, &out);
    connection.frames_.Moved(size);
    return 0;
  }

  static ssize_t Length(nghttp2_session* /*session*/, std::uint8_t /*type*/, std::int32_t /*id*/,
                        std::int32_t connection_window, std::int32_t stream_window,
                        std::uint32_t most, void* /*user*/) {
    return std::min({connection_window, stream_window, static_cast<std::int32_t>(most),
                     static_cast<std::int32_t>(kMostData)});
  }

  static const nghttp2_session_callbacks* All() {
    static const nghttp2_session_callbacks* const all = [] {
      nghttp2_session_callbacks* made = nullptr;
      nghttp2_session_callbacks_new(&made);
      nghttp2_session_callbacks_set_on_begin_frame_callback(made, OnBeginFrame);
      nghttp2_session_callbacks_set_on_begin_headers_callback(made, OnBeginHeaders);
      nghttp2_session_callbacks_set_on_header_callback(made, OnHeader);
      nghttp2_session_callbacks_set_on_frame_recv_callback(made, OnFrame);
      nghttp2_session_callbacks_set_on_data_chunk_recv_callback(made, OnData);
      nghttp2_session_callbacks_set_on_stream_close_callback(made, OnClose);
      nghttp2_session_callbacks_set_on_frame_send_callback(made, OnSent);
      nghttp2_session_callbacks_set_send_data_callback(made, OnSendData);
      nghttp2_session_callbacks_set_data_source_read_length_callback(made, Length);
      return made;
    }();
    return all;
  }

  static const nghttp2_option* Options() {
    static const nghttp2_option* const options = [] {
      nghttp2_option* made = nullptr;
      nghttp2_option_new(&made);
      nghttp2_option_set_no_auto_window_update(made, 1);
      nghttp2_option_set_no_closed_streams(made, 1);
      nghttp2_option_set_max_outbound_ack(made, kWaitingAnswers);
      nghttp2_option_set_stream_reset_rate_limit(made, kResets, kResetsPerSecond);
      return made;
    }();
    return options;
  }
};

nghttp2_session* Http2Connection::NewSession() {
  nghttp2_session* session = nullptr;
  nghttp2_session_server_new2(&session, Http2Callbacks::All(), this, Http2Callbacks::Options());
  return session;
}

nghttp2_data_provider Http2Connection::AnswerProvider() {
  return {.source = {}, .read_callback = &Http2Callbacks::OnPull};
}

}  // namespace contact::gateway
