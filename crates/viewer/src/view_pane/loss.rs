//! Collects the errors of the graphics device, which would otherwise end the program.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use eframe::wgpu;

/// The errors of a graphics device, and the reason if the device is lost.
#[derive(Clone, Debug, Default)]
pub(crate) struct Loss {
    /// Why the device is lost.
    reason: Arc<OnceLock<String>>,
    /// Errors after which the device still works, for example if it had too little memory.
    errors: Arc<Mutex<Vec<String>>>,
}

impl Loss {
    /// Watches a device.
    pub(super) fn watch(device: Option<&wgpu::Device>) -> Self {
        let loss = Self::default();
        if let Some(device) = device {
            let reason = loss.reason.clone();
            device.set_device_lost_callback(move |_, message| {
                reason.get_or_init(|| message);
            });
            let errors = loss.errors.clone();
            device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
                let mut errors = errors.lock().unwrap_or_else(PoisonError::into_inner);
                errors.push(error.to_string());
            }));
        }
        loss
    }

    /// If the device is lost, returns the reason.
    pub(crate) fn reason(&self) -> Option<&str> {
        self.reason.get().map(String::as_str)
    }

    /// Removes the errors that occurred since the last call, and returns the first of them.
    pub(crate) fn take_error(&self) -> Option<String> {
        let mut errors = self.errors.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::take(&mut *errors).into_iter().next()
    }
}
