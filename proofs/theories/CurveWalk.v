(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The walk along the curve of centres [COV-1]: from the blocker of a place to its next circle, until no site blocks, or
   the blocker has no circle beyond. *)
From Coq Require Import Reals Lra Lia Psatz List Classical Wellfounded.
From Dyadel Require Import Plane Distance Cells Legal Nerve Path Facing.
Open Scope R_scope.

(* The place at which a function that is positive at a stops being positive. *)
Lemma first_stop (h : R -> R) a t : continuity h -> 0 < h a -> h t <= 0 -> a < t ->
  exists c, a < c <= t /\ h c = 0 /\ forall s, a <= s < c -> 0 < h s.
Proof.
  intros K A T L. set (E s := a <= s <= t /\ forall r, a <= r <= s -> 0 < h r).
  destruct (completeness E) as [c [Ub Least]].
  - exists t. now intros s [[_ S] _].
  - exists a. split; [lra |]. intros r Rr. now replace r with a by lra.
  - assert (Ac : a <= c).
    { apply Ub. split; [lra |]. intros r Rr. now replace r with a by lra. }
    assert (Ct : c <= t) by (apply Least; now intros s [[_ S] _]).
    assert (Before : forall s, a <= s < c -> 0 < h s).
    { intros s S. apply NNPP. intros N. apply (Rlt_not_le c s); [lra |]. apply Least. intros e [Ie He].
      apply Rnot_lt_le. intros Se. apply N, He. lra. }
    assert (Z : h c = 0).
    { destruct (Rtotal_order (h c) 0) as [P | [P | P]]; [| exact P |].
      - destruct (near_negative h c K P) as [e [E0 H]]. destruct (Req_dec a c) as [-> | D]; [lra |].
        assert (X : exists s, a <= s < c /\ c - e <= s).
        { exists (Rmax a (c - e)). unfold Rmax. destruct (Rle_dec _ _); lra. }
        destruct X as (s & S & S'). pose proof (Before s S). specialize (H s). rewrite Rabs_left in H by lra.
        specialize (H ltac:(lra)). lra.
      - destruct (near_positive h c K P) as [e [E0 H]]. destruct (Req_dec c t) as [-> | D]; [lra |].
        assert (X : exists s, c < s <= t /\ s <= c + e).
        { exists (Rmin t (c + e)). unfold Rmin. destruct (Rle_dec _ _); lra. }
        destruct X as (s & S & S'). exfalso. apply (Rlt_not_le s c); [lra |]. apply Ub. split; [lra |]. intros r Rr.
        destruct (Rlt_dec r c) as [Rc | Rc]; [apply Before; lra |]. apply H. rewrite Rabs_pos_eq; lra. }
    exists c. split; [| now split]. split; [| exact Ct]. destruct (Req_dec a c) as [-> | D]; lra.
Qed.

Section Walk.
(* Sites below n; along the curve, f k is positive where k blocks; where it stops to be so is a circle of k, listed. *)
Variables (n : nat) (f : nat -> R -> R) (circles : nat -> list R).
Variable continuous : forall k, (k < n)%nat -> continuity (f k).
Definition stops (h : R -> R) (t : R) : Prop := h t = 0 /\ exists a, a < t /\ forall s, a <= s < t -> 0 < h s.
Variable listed : forall k t, (k < n)%nat -> stops (f k) t -> In t (circles k).
(* Who blocks the end of the curve blocks all near it. *)
Variable blocks_start : nat -> Prop.
Variable near_start : forall k, (k < n)%nat -> blocks_start k -> exists T, forall t, t <= T -> 0 < f k t.

Definition blocked (t : R) : Prop := exists k, (k < n)%nat /\ 0 < f k t.

(* Before all places, or at one. *)
Inductive spot : Type := Start | At (t : R).
Definition beyond (s : spot) (t : R) : Prop := match s with Start => True | At x => x < t end.
Definition blocks_at (k : nat) (s : spot) : Prop := match s with Start => blocks_start k | At x => 0 < f k x end.
(* The first circle of k beyond. *)
Definition next (k : nat) (s : spot) (c : R) : Prop :=
  In c (circles k) /\ beyond s c /\ forall d, In d (circles k) -> beyond s d -> c <= d.

(* The walk's answer from a place: true where no site blocks the place, false where a blocker has no circle beyond. *)
Inductive walks : spot -> bool -> Prop :=
| walks_free s : (forall k, (k < n)%nat -> ~ blocks_at k s) -> walks s true
| walks_out s k : (k < n)%nat -> blocks_at k s -> (forall d, In d (circles k) -> ~ beyond s d) -> walks s false
| walks_on s k c said : (k < n)%nat -> blocks_at k s -> next k s c -> walks (At c) said -> walks s said.

(* Where k stops to block there is a circle of k. *)
Lemma stops_at_circle k a t : (k < n)%nat -> 0 < f k a -> f k t <= 0 -> a < t -> exists c, In c (circles k) /\ a < c
  <= t.
Proof.
  intros K A T L. destruct (first_stop (f k) a t (continuous k K) A T L) as (c & C & Z & Bl).
  exists c. split; [apply listed; [exact K |] | lra]. split; [exact Z |]. exists a. split; [lra | exact Bl].
Qed.

(* Up to the next circle, k blocks; without one, for ever. *)
Lemma blocks_until k s t : (k < n)%nat -> blocks_at k s -> (match s with Start => True | At x => x <= t end) ->
  (forall d, In d (circles k) -> beyond s d -> t < d) -> 0 < f k t.
Proof.
  intros K Bl L Far. apply Rnot_le_lt. intros Z. destruct s as [| x]; simpl in *.
  - destruct (near_start k K Bl) as [T H]. set (a := Rmin T t - 1).
    assert (A : a < t /\ a <= T) by (unfold a; pose proof (Rmin_l T t); pose proof (Rmin_r T t); lra).
    destruct (stops_at_circle k a t K (H a (proj2 A)) Z (proj1 A)) as [c [C R]]. specialize (Far c C Logic.I). lra.
  - destruct (Req_dec x t) as [-> | D]; [lra |].
    destruct (stops_at_circle k x t K Bl Z ltac:(lra)) as [c [C R]]. specialize (Far c C ltac:(lra)). lra.
Qed.

(* "No": everything from the place on is blocked, ... *)
Lemma walk_no s said : walks s said -> said = false ->
  forall t, (match s with Start => True | At x => x <= t end) -> blocked t.
Proof.
  intros W. induction W as [s H | s k K Bl Out | s k c said K Bl [C [Be Least]] _ IH]; intros E t T; [discriminate | |].
  - exists k. split; [exact K |]. apply (blocks_until k s t K Bl T). intros d D Bd. now destruct (Out d D).
  - destruct (Rle_dec c t) as [L | L]; [now apply (IH E) |]. exists k. split; [exact K |].
    apply (blocks_until k s t K Bl T). intros d D Bd. specialize (Least d D Bd). lra.
Qed.

(* ... "yes": a place is blocked by no site, or the start is. *)
Lemma walk_yes s said : walks s said -> said = true ->
  (s = Start /\ forall k, (k < n)%nat -> ~ blocks_start k) \/ exists t, ~ blocked t.
Proof.
  intros W. induction W as [s H | | s k c said K Bl Nx _ IH]; intros E; [| discriminate |].
  - destruct s as [| x]; [left; now split | right]. exists x. intros [k [K L]]. now apply (H k).
  - right. destruct (IH E) as [[X _] | X]; [discriminate | exact X].
Qed.

(* The walk ends: places are circles, each beyond the one before. *)
Definition all_circles : list R := flat_map circles (seq 0 n).
Definition count_beyond (s : spot) : nat :=
  length (filter (fun t => match s with Start => true | At x => if Rlt_dec x t then true else false end) all_circles).

Lemma count_falls k s c : (k < n)%nat -> next k s c -> (count_beyond (At c) < count_beyond s)%nat.
Proof.
  intros K [C [Be _]]. unfold count_beyond. assert (I : In c all_circles).
  { apply in_flat_map. exists k. split; [apply in_seq; lia | exact C]. }
  revert I. generalize all_circles. intros l I. apply in_split in I as [l1 [l2 ->]].
  rewrite !filter_app, !app_length. simpl. destruct (Rlt_dec c c) as [X | _]; [lra |].
  assert (Le : forall m, (length (filter (fun t => if Rlt_dec c t then true else false) m) <=
    length (filter (fun t => match s with Start => true | At x => if Rlt_dec x t then true else false end) m))%nat).
  { induction m as [| t m IH]; simpl; [lia |]. destruct (Rlt_dec c t) as [X | X].
    - destruct s as [| x]; simpl in *; [lia |]. destruct (Rlt_dec x t); simpl; [lia | lra].
    - destruct (match s with Start => true | At x => if Rlt_dec x t then true else false end); simpl; lia. }
  pose proof (Le l1). pose proof (Le l2). destruct s as [| x]; simpl in *; [lia |].
  destruct (Rlt_dec x c); [simpl; lia | contradiction].
Qed.

Lemma first_of (P : R -> Prop) l : (exists c, In c l /\ P c) -> exists c, In c l /\ P c /\ forall d, In d l -> P d ->
  c <= d.
Proof.
  induction l as [| t l IH]; intros [e [I Pe]]; [destruct I |].
  destruct (classic (exists c, In c l /\ P c)) as [E | E].
  - destruct (IH E) as (c & C & Pc & Least). destruct (classic (P t /\ t < c)) as [[Pt L] | No].
    + exists t. split; [now left |]. split; [exact Pt |]. intros d [<- | D] Pd; [lra | specialize (Least d D Pd); lra].
    + exists c. split; [now right |]. split; [exact Pc |]. intros d [<- | D] Pd; [| now apply Least].
      apply Rnot_lt_le. intros L. apply No. now split.
  - destruct I as [-> | I]; [| elim E; now exists e]. exists e. split; [now left |]. split; [exact Pe |].
    intros d [<- | D] Pd; [lra | elim E; now exists d].
Qed.

Theorem walk_ends s : exists said, walks s said.
Proof.
  remember (count_beyond s) as m eqn:M. revert s M. induction m as [m IH] using (well_founded_induction lt_wf).
    intros s M.
  destruct (classic (exists k, (k < n)%nat /\ blocks_at k s)) as [[k [K Bl]] | No].
  - destruct (classic (exists c, In c (circles k) /\ beyond s c)) as [E | E].
    + destruct (first_of (beyond s) (circles k) E) as [c Nx]. pose proof (count_falls k s c K Nx) as L.
      destruct (IH (count_beyond (At c)) ltac:(rewrite M; exact L) (At c) eq_refl) as [said W]. exists said.
        now apply (walks_on s k c).
    + exists false. apply (walks_out s k K Bl). intros d D Bd. apply E. now exists d.
  - exists true. apply walks_free. intros k K Bl. apply No. now exists k.
Qed.

(* Where a site blocks the start, the walk says whether there is a place that no site blocks. *)
Theorem walk_exact said : walks Start said -> (exists k, (k < n)%nat /\ blocks_start k) ->
  (said = true <-> exists t, ~ blocked t).
Proof.
  intros W [k [K Bl]]. split.
  - intros E. destruct (walk_yes Start said W E) as [[_ H] | H]; [destruct (H k K Bl) | exact H].
  - intros [t H]. destruct said; [reflexivity |]. destruct H. now apply (walk_no Start false W).
Qed.
End Walk.

(* The pair is possible iff no site blocks one end of the curve, or the other, or the walk from the first says so. *)
Theorem walk_possible N B i j (beta : R -> point) (circles : nat -> list R) (blocks_start blocks_stop : nat -> Prop) :
  (i < N)%nat -> (j < N)%nat ->
  continuity (fun t => fst (beta t)) -> continuity (fun t => snd (beta t)) ->
  (forall c, ds c (B i) = ds c (B j) <-> exists t, c = beta t) ->
  (forall k t, (k < N)%nat -> stops (fun s => ds (beta s) (B i) - dl (beta s) (B k)) t -> In t (circles k)) ->
  (forall k, (k < N)%nat -> blocks_start k -> exists T, forall t, t <= T -> 0 < ds (beta t) (B i) - dl (beta t) (B k))
    ->
  ((exists u, possible_far N B (pair i j) u /\ dot u (highest u (B i)) = dot u (highest u (B j))) <->
    (forall k, (k < N)%nat -> ~ blocks_start k) \/ (forall k, (k < N)%nat -> ~ blocks_stop k)) ->
  (possible N B i j <-> (forall k, (k < N)%nat -> ~ blocks_start k) \/ (forall k, (k < N)%nat -> ~ blocks_stop k) \/
    walks N (fun k t => ds (beta t) (B i) - dl (beta t) (B k)) circles blocks_start Start true).
Proof.
  intros I J Cx Cy Curve Listed Near Ends. set (f := fun k t => ds (beta t) (B i) - dl (beta t) (B k)) in *.
  assert (Cont : forall k, (k < N)%nat -> continuity (f k)).
  { intros k _ t e He. destruct (Cx t (e / 8)) as [a [A Ha]]; [lra |]. destruct (Cy t (e / 8)) as [b [Pb Hb]]; [lra |].
    assert (G : exists r, 0 < r /\ r <= a /\ r <= b).
    { exists (Rmin a b). split; [now apply Rmin_pos | split; [apply Rmin_l | apply Rmin_r]]. }
    destruct G as (r & R0 & Ra & Rb). exists r. split; [exact R0 |]. intros s [S D]. simpl in *. unfold R_dist in *.
    assert (Da : Rabs (s - t) < a) by lra. assert (Db : Rabs (s - t) < b) by lra.
    specialize (Ha s (conj S Da)). specialize (Hb s (conj S Db)).
    pose proof (dist_le_sum (beta s) (beta t)) as Q. pose proof (dist_sym (beta s) (beta t)) as Sy.
    pose proof (ds_move (beta s) (beta t) (B i)). pose proof (ds_move (beta t) (beta s) (B i)).
    pose proof (dl_move (beta s) (beta t) (B k)). pose proof (dl_move (beta t) (beta s) (B k)).
    apply Rabs_def1; unfold f; lra. }
  assert (Free : (exists t, ~ blocked N f t) <->
    exists c, ds c (B i) = ds c (B j) /\ forall k, (k < N)%nat -> k <> i -> k <> j -> ~ blocks c (B i) (B k)).
  { split.
    - intros [t H]. exists (beta t). split; [apply Curve; now exists t |]. intros k K _ _ Bl. apply H. exists k.
      split; [exact K |]. unfold blocks in Bl. unfold f. lra.
    - intros [c [E H]]. pose proof E as E'. apply Curve in E'. destruct E' as [t ->]. exists t. intros [k [K L]].
      unfold f in L.
      destruct (Nat.eq_dec k i) as [-> | Di]; [pose proof (ds_le_dl (beta t) (B i)); lra |].
      destruct (Nat.eq_dec k j) as [-> | Dj]; [pose proof (ds_le_dl (beta t) (B j)); lra |].
      apply (H k K Di Dj). unfold blocks. lra. }
  rewrite (tangents_suffice N B i j I J), <- Free, Ends.
  destruct (classic (exists k, (k < N)%nat /\ blocks_start k)) as [Some | None].
  - destruct (walk_ends N f circles blocks_start Start) as [said W].
    pose proof (fun w => walk_exact N f circles Cont Listed blocks_start Near w) as Ex. split.
    + intros [H | [H | H]]; [right; right | now left | right; now left].
      apply (Ex said W Some) in H. now rewrite H in W.
    + intros [H | [H | H]]; [right; now left | right; now right | left]. now apply (Ex true H Some).
  - assert (H : forall k, (k < N)%nat -> ~ blocks_start k) by (intros k K Bl; apply None; now exists k). tauto.
Qed.
