//! Ctrl-C.

use crate::build::CancelToken;
use std::sync::OnceLock;

/// The token that Ctrl-C cancels: builds stop, and what is finished is kept.
///
/// A process has one signal handler, so there is one token, made when it is first asked for.
pub(super) fn token() -> CancelToken {
    static TOKEN: OnceLock<CancelToken> = OnceLock::new();
    let token = TOKEN.get_or_init(|| {
        let token = CancelToken::default();
        let cancelled = token.clone();
        // Where no handler can be set, Ctrl-C ends the process; the cache survives that too.
        let _unheard = ctrlc::set_handler(move || cancelled.cancel());
        token
    });
    token.clone()
}
