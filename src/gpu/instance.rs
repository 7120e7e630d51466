//! The loader, the instance, and the messages of the validation layer.

use super::check;
use crate::{Error, Result};
use ash::{ext, vk};
use std::ffi::{CStr, OsStr, c_char, c_void};
use std::io::Write as _;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Held while an instance or a device is made or destroyed. Threads that do so at once stop for ever in NVIDIA's driver
/// 580.159.
static DOOR: Mutex<()> = Mutex::new(());

/// Waits until no other thread makes or destroys an instance or a device.
pub(super) fn door() -> MutexGuard<'static, ()> {
    DOOR.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Messages that no work took as its error.
static LATE: AtomicUsize = AtomicUsize::new(0);

/// Whether the environment asks for the validation layer: `DAPPLE_VALIDATION` is there, not empty and not `0`.
pub fn validation_from_environment() -> bool {
    asks(std::env::var_os("DAPPLE_VALIDATION").as_deref())
}

fn asks(value: Option<&OsStr>) -> bool {
    value.is_some_and(|value| !value.is_empty() && value != "0")
}

/// How many messages of the validation layer came too late to be an error of any work, as while a device was taken down.
/// Each was printed on stderr.
pub fn late_messages() -> usize {
    LATE.load(Ordering::Relaxed)
}

/// Messages that the validation layer gave since they were last taken. What is left at the end is printed and counted.
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

impl Drop for Messages {
    fn drop(&mut self) {
        for message in self.take() {
            LATE.fetch_add(1, Ordering::Relaxed);
            // Without stderr there is still the count.
            _ = writeln!(std::io::stderr(), "the validation layer says: {message}");
        }
    }
}

/// The instance; dropped after everything that was made from it.
pub(super) struct Instance {
    pub(super) raw: ash::Instance,
    pub(super) messages: Arc<Messages>,
    debug: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    // The loaded library must outlive the instance.
    entry: ash::Entry,
}

impl Instance {
    /// Loads the Vulkan loader and makes an instance. With `validation`, the layer must be installed.
    pub(super) fn new(validation: bool) -> Result<Arc<Self>> {
        // SAFETY: loading libvulkan runs its initialisers; it is the system's own loader.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| no_loader(&error))?;
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
        // This one hears what is said while the instance itself is made and destroyed.
        let mut listener = messenger(&messages);
        let mut info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_layer_names(&layers)
            .enabled_extension_names(&extensions);
        if validation {
            info = info.push_next(&mut listener);
        }
        let door = door();
        // SAFETY: all pointers in `info` live until the call returns.
        let raw = unsafe { entry.create_instance(&info, None) }.map_err(|code| match code {
            vk::Result::ERROR_INCOMPATIBLE_DRIVER => no_driver(),
            code => Error::device(format!("create the Vulkan instance: Vulkan says {code:?}")),
        })?;
        drop(door);
        let mut instance = Self { raw, messages, debug: None, entry };
        if validation {
            instance.debug = Some(listen(&instance)?);
        }
        Ok(Arc::new(instance))
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        let _door = door();
        // SAFETY: devices hold an `Arc` of this instance, so none is left; both objects are ours.
        unsafe {
            if let Some((debug, messenger)) = &self.debug {
                debug.destroy_debug_utils_messenger(*messenger, None);
            }
            self.raw.destroy_instance(None);
        }
    }
}

/// The error for a machine without a loader.
fn no_loader(error: &ash::LoadingError) -> Error {
    Error::device(format!("no Vulkan loader on this machine ({error})"))
        .help("install one; on Debian: apt-get install libvulkan1 mesa-vulkan-drivers")
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

fn listen(instance: &Instance) -> Result<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)> {
    let debug = ext::debug_utils::Instance::new(&instance.entry, &instance.raw);
    let info = messenger(&instance.messages);
    // SAFETY: the user data points into the `Arc` that the instance keeps until the messenger is destroyed.
    let made = check(unsafe { debug.create_debug_utils_messenger(&info, None) }, "listen to validation")?;
    Ok((debug, made))
}

/// A messenger that keeps messages. They must outlive what is made from it.
fn messenger(messages: &Arc<Messages>) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
    vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(
            vk::DebugUtilsMessageSeverityFlagsEXT::ERROR | vk::DebugUtilsMessageSeverityFlagsEXT::WARNING,
        )
        .message_type(
            vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
        )
        .pfn_user_callback(Some(on_message))
        .user_data(Arc::as_ptr(messages).cast_mut().cast())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::{DeviceChoice, Gpu};

    #[test]
    fn the_variable_has_one_meaning() {
        for (value, meaning) in
            [(None, false), (Some(""), false), (Some("0"), false), (Some("1"), true), (Some("yes"), true)]
        {
            assert_eq!(asks(value.map(OsStr::new)), meaning, "{value:?}");
        }
    }

    #[test]
    fn a_missing_loader_is_told_with_what_to_install() {
        // SAFETY: there is no such library, so nothing of it runs.
        let error = unsafe { ash::Entry::load_from("no-such-folder/libvulkan.so.1") }.err().unwrap();
        let error = no_loader(&error);
        assert!(error.message.starts_with("no Vulkan loader on this machine ("), "{error}");
        assert!(error.message.contains("no-such-folder/libvulkan.so.1"), "{error}");
        assert!(error.help.unwrap().contains("apt-get install libvulkan1"));
        assert!(no_driver().to_string().contains("apt-get install mesa-vulkan-drivers"));
    }

    #[test]
    fn what_is_said_while_a_device_goes_is_counted() {
        let gpu = match Gpu::open(&DeviceChoice { validation: true, ..DeviceChoice::default() }) {
            Ok(gpu) => gpu,
            Err(error) if error.message.contains("validation layer is not installed") => {
                assert!(std::env::var_os("CI").is_none_or(|v| v != "true"), "{error}");
                eprintln!("SKIPPED: {error}");
                return;
            }
            Err(error) => panic!("{error}"),
        };
        let before = late_messages();
        let info = vk::BufferCreateInfo::default().size(16).usage(vk::BufferUsageFlags::STORAGE_BUFFER);
        // SAFETY: the device is alive. That the buffer is never destroyed is what the layer must complain of.
        unsafe { gpu.inner.device.create_buffer(&info, None) }.unwrap();
        drop(gpu);
        assert!(late_messages() > before, "nothing was said of a buffer that was left over");
    }
}
