// The connection to the server: the newest takes the seat, a lost one is tried again.
const REPLACED = 4001, REFUSED = 4003;

export function link(role, handlers) {
  const token = location.pathname.split("/").pop();
  const key = `seat ${token}`;
  const state = { socket: null, wait: 500, closed: false, roundTrip: null };

  function open() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/ws`);
    state.socket = socket;
    socket.onopen = () => {
      state.wait = 500;
      const ids = Object.fromEntries([...new URLSearchParams(location.search)].slice(0, 8)
        .map(([name, value]) => [name.slice(0, 300), value.slice(0, 300)]));
      socket.send(JSON.stringify({ type: "hello", token, person: sessionStorage.getItem(key), ids,
        agent: navigator.userAgent.slice(0, 300), width: innerWidth, height: innerHeight,
        view: handlers.view ? handlers.view() : "plan" }));
    };
    socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      if (message.type === "ping") {
        send({ type: "pong", id: message.id });
        state.roundTrip = message.round_trip_ms;
        return;
      }
      if (message.type === "welcome" && message.person) sessionStorage.setItem(key, message.person);
      const handler = handlers[message.type];
      if (handler) handler(message);
    };
    socket.onclose = (event) => {
      if (state.closed) return;
      if (event.code === REPLACED) { handlers.gone("This study was opened in another tab or window."); return; }
      if (event.code === REFUSED) { handlers.gone("This link is not valid any more."); return; }
      if (event.code === 1000) return;
      handlers.lost();
      setTimeout(open, state.wait);
      state.wait = Math.min(state.wait * 1.6, 5000);
    };
  }

  function send(message) {
    if (state.socket && state.socket.readyState === WebSocket.OPEN) state.socket.send(JSON.stringify(message));
  }

  open();
  // The round trip is the server's median, in ms; null before it knows one.
  // The seat is what this tab's person is known by after a reload; null before there is one.
  return { send, seat: () => sessionStorage.getItem(key), roundTrip: () => state.roundTrip, close: () => { state.closed = true; } };
}
