(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Areas of sets in the plane: upper bounds on the Lebesgue outer measure, and lower bounds from inside. Both are said
   by means of rectangles; MeasureRect.v shows that the measure of a rectangle is its area. *)
From Coq Require Import Reals Lra Lia List.
From Dyadel Require Import Plane Distance.
Import ListNotations.
Open Scope R_scope.

Definition area (Q : rect) : R := (xhi Q - xlo Q) * (yhi Q - ylo Q).

Fixpoint sum_below (f : nat -> R) (n : nat) : R := match n with O => 0 | S k => sum_below f k + f k end.

(* The Lebesgue outer measure of A, the infimum of the sums of areas of countably many rectangles that cover A, is at
   most m. *)
Definition measure_le (A : point -> Prop) (m : R) : Prop :=
  forall e, 0 < e -> exists Q : nat -> rect,
    (forall z, A z -> exists n, inside z (Q n)) /\ (forall n, sum_below (fun k => area (Q k)) n <= m + e).

(* The same with finitely many rectangles: the outer Jordan content. *)
Fixpoint areas (L : list rect) : R := match L with [] => 0 | Q :: K => area Q + areas K end.
Definition covers (L : list rect) (A : point -> Prop) : Prop := forall z, A z -> exists Q, In Q L /\ inside z Q.
Definition content_le (A : point -> Prop) (m : R) : Prop :=
  forall e, 0 < e -> exists L, covers L A /\ areas L <= m + e.

(* A holds the interiors of finitely many rectangles, no two of which overlap, that have an area of at least m, up to
   any e > 0: the inner Jordan content of A is at least m. *)
Definition strictly (z : point) (Q : rect) : Prop := xlo Q < fst z < xhi Q /\ ylo Q < snd z < yhi Q.
Definition apart (P Q : rect) : Prop := forall z, strictly z P -> ~ strictly z Q.
Definition within (A : point -> Prop) (Q : rect) : Prop := forall z, strictly z Q -> A z.
Definition inner_ge (A : point -> Prop) (m : R) : Prop :=
  forall e, 0 < e -> exists L, Forall (within A) L /\ ForallOrdPairs apart L /\ m - e <= areas L.

Lemma area_nonneg Q : 0 <= area Q.
Proof. pose proof (x_ordered Q). pose proof (y_ordered Q). apply Rmult_le_pos; lra. Qed.

Lemma areas_app K L : areas (K ++ L) = areas K + areas L.
Proof. induction K as [| Q K IH]; simpl; lra. Qed.

Lemma areas_nonneg L : 0 <= areas L.
Proof. induction L as [| Q L IH]; simpl; [lra |]. pose proof (area_nonneg Q). lra. Qed.

(* ---- from outside ---- *)

Definition origin : rect := Rect 0 0 0 0 (Rle_refl 0) (Rle_refl 0).

Lemma sum_below_list L n : sum_below (fun k => area (nth k L origin)) n <= areas L.
Proof.
  revert n. induction L as [| Q L IH]; intros n.
  - simpl. assert (E : forall k, area (nth k [] origin) = 0) by (intros [| k]; unfold area; simpl; ring).
    induction n as [| n IH]; simpl; [lra |]. specialize (E n). simpl in E. lra.
  - destruct n as [| n]; [apply (areas_nonneg (Q :: L)) |].
    assert (E : sum_below (fun k => area (nth k (Q :: L) origin)) (S n)
              = area Q + sum_below (fun k => area (nth k L origin)) n).
    { induction n as [| n IHn]; [simpl; ring |]. simpl in *. rewrite IHn. ring. }
    rewrite E. specialize (IH n). simpl. lra.
Qed.

Theorem measure_of_content A m : content_le A m -> measure_le A m.
Proof.
  intros H e E. destruct (H e E) as [L [C S]]. exists (fun n => nth n L origin). split.
  - intros z Z. destruct (C z Z) as [Q [I D]]. destruct (In_nth _ _ origin I) as [n [_ <-]]. now exists n.
  - intros n. pose proof (sum_below_list L n). lra.
Qed.

Theorem measure_subset (A B : point -> Prop) m n :
  (forall z, A z -> B z) -> m <= n -> measure_le B m -> measure_le A n.
Proof.
  intros I M H e E. destruct (H e E) as [Q [C S]]. exists Q. split; [intros z Z; now apply C, I |].
  intros k. specialize (S k). lra.
Qed.

Lemma content_subset (A B : point -> Prop) m n :
  (forall z, A z -> B z) -> m <= n -> content_le B m -> content_le A n.
Proof.
  intros I M H e E. destruct (H e E) as [L [C S]]. exists L. split; [intros z Z; now apply C, I | lra].
Qed.

Lemma content_empty : content_le (fun _ => False) 0.
Proof. intros e E. exists []. split; [now intros z [] | simpl; lra]. Qed.

Lemma content_union A B m n : content_le A m -> content_le B n -> content_le (fun z => A z \/ B z) (m + n).
Proof.
  intros H G e E. destruct (H (e / 2)) as [K [CK SK]]; [lra |]. destruct (G (e / 2)) as [L [CL SL]]; [lra |].
  exists (K ++ L). split; [| rewrite areas_app; lra].
  intros z [Z | Z]; [destruct (CK z Z) as [Q [I D]] | destruct (CL z Z) as [Q [I D]]]; exists Q;
    (split; [apply in_or_app; tauto | exact D]).
Qed.

(* ---- from inside ---- *)

Lemma strictly_inside z Q : strictly z Q -> inside z Q.
Proof. unfold strictly, inside. lra. Qed.

(* A rectangle without interior has area 0. *)
Lemma no_interior Q : (forall z, ~ strictly z Q) -> area Q = 0.
Proof.
  intros H. pose proof (x_ordered Q). pose proof (y_ordered Q). unfold area.
  destruct (Req_dec (xlo Q) (xhi Q)) as [-> | X]; [ring |].
  destruct (Req_dec (ylo Q) (yhi Q)) as [-> | Y]; [ring |].
  exfalso. apply (H ((xlo Q + xhi Q) / 2, (ylo Q + yhi Q) / 2)). unfold strictly. simpl. lra.
Qed.

Lemma within_subset (A B : point -> Prop) L : (forall z, A z -> B z) -> Forall (within A) L -> Forall (within B) L.
Proof. intros I. apply Forall_impl. intros Q W z Z. now apply I, W. Qed.

Lemma inner_subset (A B : point -> Prop) m n : (forall z, A z -> B z) -> n <= m -> inner_ge A m -> inner_ge B n.
Proof.
  intros I M H e E. destruct (H e E) as [L [W [D S]]]. exists L.
  split; [now apply (within_subset A) |]. split; [exact D | lra].
Qed.

Lemma inner_trivial A m : m <= 0 -> inner_ge A m.
Proof. intros M e E. exists []. split; [constructor |]. split; [constructor | simpl; lra]. Qed.

Lemma pairs_app {T : Type} (R : T -> T -> Prop) K L : ForallOrdPairs R K -> ForallOrdPairs R L ->
  (forall a b, In a K -> In b L -> R a b) -> ForallOrdPairs R (K ++ L).
Proof.
  intros HK HL X. induction HK as [| a K F HK IH]; [exact HL |]. simpl. constructor.
  - apply Forall_app. split; [exact F |]. apply Forall_forall. intros b B. apply X; [now left | exact B].
  - apply IH. intros b c B C. apply X; [now right | exact C].
Qed.

Lemma apart_of_disjoint (A B : point -> Prop) K L : (forall z, A z -> ~ B z) ->
  Forall (within A) K -> Forall (within B) L -> forall P Q, In P K -> In Q L -> apart P Q.
Proof.
  intros D WK WL P Q IP IQ z ZP ZQ. rewrite Forall_forall in WK, WL.
  exact (D z (WK P IP z ZP) (WL Q IQ z ZQ)).
Qed.

Lemma inner_union (A B C : point -> Prop) m n : (forall z, A z -> ~ B z) ->
  (forall z, A z -> C z) -> (forall z, B z -> C z) -> inner_ge A m -> inner_ge B n -> inner_ge C (m + n).
Proof.
  intros D SA SB H G e E. destruct (H (e / 2)) as [K [WK [DK SK]]]; [lra |].
  destruct (G (e / 2)) as [L [WL [DL SL]]]; [lra |]. exists (K ++ L). split; [| split].
  - apply Forall_app. split; [now apply (within_subset A) | now apply (within_subset B)].
  - apply pairs_app; [exact DK | exact DL |]. now apply (apart_of_disjoint A B).
  - rewrite areas_app. lra.
Qed.
