//! The loader, the instance, and the messages of the validation layer.

use super::check;
use crate::{Error, Result};
use ash::{ext, vk};
use std::ffi::{CStr, c_char, c_void};
use std::sync::{Arc, Mutex, PoisonError};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Messages that the validation layer gave since they were last taken.
#[derive(Debug, Default)]
pub(super) struct Messages(Mutex<Vec<String>>);

impl Messages {
    pub(super) fn take(&self) -> Vec<String> {
        std::mem::take(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn push(&self, message: String) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(message);
    }
}

/// The instance; dropped after everything that was made from it.
pub(super) struct Instance {
    pub(super) raw: ash::Instance,
    pub(super) messages: Arc<Messages>,
    debug: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    // The loaded library must outlive the instance.
    _entry: ash::Entry,
}

impl Instance {
    /// Loads the Vulkan loader and makes an instance. With `validation`, the layer must be installed.
    pub(super) fn new(validation: bool) -> Result<Arc<Self>> {
        // SAFETY: loading libvulkan runs its initialisers; it is the system's own loader.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| {
            Error::device(format!("no Vulkan loader on this machine ({error})"))
                .help("install one; on Debian: apt-get install libvulkan1 mesa-vulkan-drivers")
        })?;
        // SAFETY: the entry is loaded.
        let version = check(unsafe { entry.try_enumerate_instance_version() }, "ask the loader's version")?;
        if version.unwrap_or(vk::API_VERSION_1_0) < vk::API_VERSION_1_1 {
            return Err(Error::device("the Vulkan loader is of version 1.0; dapple needs 1.2")
                .help("update libvulkan"));
        }
        let messages = Arc::new(Messages::default());
        let layers = if validation { vec![VALIDATION_LAYER.as_ptr()] } else { Vec::new() };
        if validation {
            require_layer(&entry)?;
        }
        let extensions: Vec<*const c_char> =
            if validation { vec![ext::debug_utils::NAME.as_ptr()] } else { Vec::new() };
        let application = vk::ApplicationInfo::default()
            .application_name(c"dapple")
            .engine_name(c"dapple")
            .api_version(vk::API_VERSION_1_2);
        let info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_layer_names(&layers)
            .enabled_extension_names(&extensions);
        // SAFETY: all pointers in `info` live until the call returns.
        let raw = unsafe { entry.create_instance(&info, None) }.map_err(|code| match code {
            vk::Result::ERROR_INCOMPATIBLE_DRIVER => no_driver(),
            code => Error::device(format!("create the Vulkan instance: Vulkan says {code:?}")),
        })?;
        let debug = validation.then(|| listen(&entry, &raw, &messages)).transpose()?;
        Ok(Arc::new(Self { raw, messages, debug, _entry: entry }))
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: devices hold an `Arc` of this instance, so none is left; both objects are ours.
        unsafe {
            if let Some((debug, messenger)) = &self.debug {
                debug.destroy_debug_utils_messenger(*messenger, None);
            }
            self.raw.destroy_instance(None);
        }
    }
}

/// The error for a machine on which no driver answers.
pub(super) fn no_driver() -> Error {
    Error::device("no Vulkan driver on this machine").help(
        "install one; on Debian the software driver: apt-get install mesa-vulkan-drivers; `dapple devices` shows the loader variables",
    )
}

fn require_layer(entry: &ash::Entry) -> Result<()> {
    // SAFETY: the entry is loaded.
    let layers = check(unsafe { entry.enumerate_instance_layer_properties() }, "list the layers")?;
    let found = layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER));
    if found {
        return Ok(());
    }
    Err(Error::device("the Vulkan validation layer is not installed")
        .help("on Debian: apt-get install vulkan-validationlayers, or unset DAPPLE_VALIDATION"))
}

fn listen(
    entry: &ash::Entry,
    instance: &ash::Instance,
    messages: &Arc<Messages>,
) -> Result<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)> {
    let debug = ext::debug_utils::Instance::new(entry, instance);
    let info = vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(
            vk::DebugUtilsMessageSeverityFlagsEXT::ERROR | vk::DebugUtilsMessageSeverityFlagsEXT::WARNING,
        )
        .message_type(
            vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
        )
        .pfn_user_callback(Some(on_message))
        .user_data(Arc::as_ptr(messages).cast_mut().cast());
    // SAFETY: the user data points into the `Arc` that the instance keeps until the messenger is destroyed.
    let messenger =
        check(unsafe { debug.create_debug_utils_messenger(&info, None) }, "listen to validation")?;
    Ok((debug, messenger))
}

unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: `user` is the `Messages` given to `listen`; the layer passes valid data for the time of the call.
    let (messages, text) = unsafe {
        let text =
            (*data).message_as_c_str().map_or_else(String::new, |text| text.to_string_lossy().into_owned());
        (&*user.cast::<Messages>(), text)
    };
    messages.push(text);
    vk::FALSE
}
