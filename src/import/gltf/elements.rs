//! The elements of accessors: numbers of all component types, normalised or not, with sparse replacements.

use super::accessor::{Accessor, Component, Run, Sparse};
use super::budget::Budget;
use super::buffers::Buffers;
use crate::Result;

/// Numbers of `count` elements of a run; `decode` makes a number of its bytes.
fn gather<T: Copy + Default, const S: usize, const N: usize>(
    buffers: &Buffers,
    run: Run,
    count: usize,
    decode: impl Fn([u8; S]) -> T,
) -> Vec<[T; N]> {
    let bytes = buffers.bytes(run.view).get(run.offset..).unwrap_or_default();
    let element = |i: usize| {
        // The whole element lies in the view: that was checked when the accessor was read
        let words = bytes.get(i * run.stride..).unwrap_or_default().as_chunks::<S>().0;
        let mut numbers = [T::default(); N];
        numbers.iter_mut().zip(words).for_each(|(number, word)| *number = decode(*word));
        numbers
    };
    (0..count).map(element).collect()
}

/// Elements as 32-bit floats. Normalised numbers become 0 to 1, or −1 to 1 (glTF 2.0, section 3.11).
fn float_run<const N: usize>(
    buffers: &Buffers,
    run: Run,
    count: usize,
    component: Component,
    normalized: bool,
) -> Vec<[f32; N]> {
    let most = |n: f32| if normalized { 1.0 / n } else { 1.0 };
    let signed = |x: f32| if normalized { x.max(-1.0) } else { x };
    match component {
        Component::I8 => {
            let factor = most(127.0);
            gather(buffers, run, count, |b| signed(f32::from(i8::from_le_bytes(b)) * factor))
        }
        Component::U8 => {
            let factor = most(255.0);
            gather(buffers, run, count, |b| f32::from(u8::from_le_bytes(b)) * factor)
        }
        Component::I16 => {
            let factor = most(32767.0);
            gather(buffers, run, count, |b| signed(f32::from(i16::from_le_bytes(b)) * factor))
        }
        Component::U16 => {
            let factor = most(65535.0);
            gather(buffers, run, count, |b| f32::from(u16::from_le_bytes(b)) * factor)
        }
        Component::U32 => gather(buffers, run, count, |b| u32::from_le_bytes(b) as f32),
        Component::F32 => gather(buffers, run, count, f32::from_le_bytes),
    }
}

/// Elements of whole numbers.
fn whole_run<const N: usize>(
    buffers: &Buffers,
    run: Run,
    count: usize,
    component: Component,
) -> Vec<[u32; N]> {
    match component {
        Component::U8 => gather(buffers, run, count, |b| u32::from(u8::from_le_bytes(b))),
        Component::U16 => gather(buffers, run, count, |b| u32::from(u16::from_le_bytes(b))),
        _ => gather(buffers, run, count, u32::from_le_bytes),
    }
}

impl Accessor {
    /// The elements as floats, all finite. The accessor must have N numbers an element.
    pub fn floats<const N: usize>(&self, buffers: &Buffers, budget: &Budget) -> Result<Vec<[f32; N]>> {
        self.check_width(N)?;
        let read = |run, count| float_run(buffers, run, count, self.component, self.normalized);
        let elements = self.elements(buffers, budget, [0.0; N], read)?;
        let wrong = elements.iter().position(|element| !element.iter().all(|x| x.is_finite()));
        if let Some(i) = wrong {
            return Err(self.error(format!("element {i} is {:?}, must be of finite numbers", elements[i])));
        }
        Ok(elements)
    }

    /// The elements as whole numbers that are not negative. The accessor must have N numbers an element.
    pub fn wholes<const N: usize>(&self, buffers: &Buffers, budget: &Budget) -> Result<Vec<[u32; N]>> {
        self.check_width(N)?;
        if !matches!(self.component, Component::U8 | Component::U16 | Component::U32) || self.normalized {
            let (kind, name) = (if self.normalized { "normalized " } else { "" }, self.component.name());
            return Err(self
                .error(format!("elements are of type {kind}{name}, must be whole numbers without a sign")));
        }
        self.elements(buffers, budget, [0; N], |run, count| whole_run(buffers, run, count, self.component))
    }

    fn check_width(&self, width: usize) -> Result<()> {
        if self.width == width {
            return Ok(());
        }
        Err(self.error(format!("elements are of type {}, must have {width} numbers", self.kind)))
    }

    /// The elements of the base, or as many of `zero`, and then those that the sparse part replaces.
    fn elements<T: Copy>(
        &self,
        buffers: &Buffers,
        budget: &Budget,
        zero: T,
        read: impl Fn(Run, usize) -> Vec<T>,
    ) -> Result<Vec<T>> {
        budget.take(self.count, size_of::<T>()).map_err(|error| self.error(error.message))?;
        let mut elements = match self.base {
            Some(run) => read(run, self.count),
            None => vec![zero; self.count],
        };
        let Some(Sparse { count, component, indices, values }) = self.sparse else { return Ok(elements) };
        budget.take(count, size_of::<T>() + size_of::<u32>())?;
        let places = whole_run::<1>(buffers, indices, count, component);
        for ([place], value) in places.into_iter().zip(read(values, count)) {
            let Some(element) = elements.get_mut(place as usize) else {
                return Err(self.error(format!(
                    "the sparse index {place} is not below {}, the number of elements",
                    self.count
                )));
            };
            *element = value;
        }
        Ok(elements)
    }
}
