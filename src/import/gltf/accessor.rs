//! Accessors: what the bytes of a view are, checked against its size before anything is read.

use super::buffers::Buffers;
use super::json::{Json, error_at};
use crate::{Error, Result};

/// Type of the numbers of an accessor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn read(json: &Json<'_>) -> Result<Self> {
        Ok(match json.whole()? {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            other => return Err(json.error(format!("{other} is no component type"))),
        })
    }

    /// Bytes.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::I8 => "BYTE",
            Self::U8 => "UNSIGNED_BYTE",
            Self::I16 => "SHORT",
            Self::U16 => "UNSIGNED_SHORT",
            Self::U32 => "UNSIGNED_INT",
            Self::F32 => "FLOAT",
        }
    }
}

/// Elements in a view: where the first begins, and how far the next one is.
#[derive(Clone, Copy)]
pub(super) struct Run {
    pub view: usize,
    pub offset: usize,
    pub stride: usize,
}

/// Elements that replace those of the base.
#[derive(Clone, Copy)]
pub(super) struct Sparse {
    pub count: usize,
    pub component: Component,
    pub indices: Run,
    pub values: Run,
}

/// A list of elements of 1 to 16 numbers.
pub(super) struct Accessor {
    pub pointer: String,
    pub component: Component,
    /// `SCALAR`, `VEC3` and so on.
    pub kind: &'static str,
    pub width: usize,
    pub count: usize,
    pub normalized: bool,
    /// None: all numbers are 0.
    pub base: Option<Run>,
    pub sparse: Option<Sparse>,
}

/// Names of elements and how many numbers they have.
const KINDS: [(&str, usize); 7] =
    [("SCALAR", 1), ("VEC2", 2), ("VEC3", 3), ("VEC4", 4), ("MAT2", 4), ("MAT3", 9), ("MAT4", 16)];

impl Accessor {
    /// Reads the description of an accessor. Its elements lie in its views.
    pub fn read(json: &Json<'_>, buffers: &Buffers) -> Result<Self> {
        let component = Component::read(&json.need("componentType")?)?;
        let kind = json.need("type")?;
        let name = kind.string()?;
        let Some(&(name, width)) = KINDS.iter().find(|(known, _)| *known == name) else {
            return Err(kind.error("this is no type of elements"));
        };
        let count = json.need("count")?;
        let pointer = json.pointer().to_owned();
        let normalized = json.flag("normalized")?;
        let count = match count.whole()? {
            0 => return Err(count.error("there must be 1 element at least")),
            count => count,
        };
        if normalized && matches!(component, Component::F32 | Component::U32) {
            return Err(json.error(format!("numbers of type {} cannot be normalized", component.name())));
        }
        for key in ["min", "max"] {
            if let Some(bound) = json.get(key)? {
                check_bound(&bound, width)?;
            }
        }
        let mut accessor =
            Self { pointer, component, kind: name, width, count, normalized, base: None, sparse: None };
        let size = accessor.size();
        if let Some(view) = json.get("bufferView")? {
            let view = buffers.view(&view)?;
            let stride = buffers.stride(view).unwrap_or(size);
            let run = Run { view, offset: json.whole_or("byteOffset", 0)?, stride };
            check_run(json, buffers, run, size, count)?;
            accessor.base = Some(run);
        }
        accessor.sparse = json.get("sparse")?.map(|sparse| accessor.sparse(&sparse, buffers)).transpose()?;
        Ok(accessor)
    }

    /// Bytes of an element. Columns of matrices begin at whole words.
    fn size(&self) -> usize {
        let size = self.component.size();
        match self.kind {
            "MAT2" => 2 * (2 * size).next_multiple_of(4),
            "MAT3" => 3 * (3 * size).next_multiple_of(4),
            _ => self.width * size,
        }
    }

    fn sparse(&self, json: &Json<'_>, buffers: &Buffers) -> Result<Sparse> {
        let count = json.need("count")?;
        let number = count.whole()?;
        if number == 0 || number > self.count {
            return Err(count.error(format!("{number} of {} elements cannot be replaced", self.count)));
        }
        let indices = json.need("indices")?;
        let kind = indices.need("componentType")?;
        let component = Component::read(&kind)?;
        if !matches!(component, Component::U8 | Component::U16 | Component::U32) {
            return Err(kind.error(format!("indices cannot be of type {}", component.name())));
        }
        let run = |json: &Json<'_>, size: usize| -> Result<Run> {
            let reference = json.need("bufferView")?;
            let view = buffers.view(&reference)?;
            if buffers.stride(view).is_some() {
                return Err(reference.error("the view of a sparse accessor has a stride"));
            }
            let run = Run { view, offset: json.whole_or("byteOffset", 0)?, stride: size };
            check_run(json, buffers, run, size, number)?;
            Ok(run)
        };
        let values = run(&json.need("values")?, self.size())?;
        Ok(Sparse { count: number, component, indices: run(&indices, component.size())?, values })
    }

    /// An error about the elements.
    pub fn error(&self, message: impl AsRef<str>) -> Error {
        error_at(&self.pointer, message)
    }
}

fn check_bound(bound: &Json<'_>, width: usize) -> Result<()> {
    let items = bound.items()?;
    if items.len() != width {
        return Err(bound.error(format!("this is a list of {}, must be of {width} numbers", items.len())));
    }
    items.iter().try_for_each(|item| item.number().map(drop))
}

fn check_run(json: &Json<'_>, buffers: &Buffers, run: Run, size: usize, count: usize) -> Result<()> {
    if run.stride < size {
        return Err(
            json.error(format!("an element has {size} bytes, the stride of its view is {}", run.stride))
        );
    }
    let end = (count - 1).checked_mul(run.stride).and_then(|n| n.checked_add(size)?.checked_add(run.offset));
    let has = buffers.bytes(run.view).len();
    if end.is_none_or(|end| end > has) {
        let Run { view, offset, stride } = run;
        return Err(json.error(format!(
            "{count} elements {stride} bytes apart from byte {offset} on do not fit into /bufferViews/{view} of {has} bytes"
        )));
    }
    Ok(())
}
